//! The program as its users meet it: each test runs it in a folder of its own.

mod ask;
mod bake;
mod diff;
mod displays;
mod errors;
mod example;
mod examples;
mod export;
mod files;
mod fmt;
mod generate;
mod inspect;
mod join;
mod knobs;
mod manual;
mod memory;
mod needs;
mod pixel;
mod program;
mod render;
mod report;
mod stability;
mod tune;
mod turntable;
mod view;
