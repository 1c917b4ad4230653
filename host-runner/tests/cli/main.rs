//! The program as its users meet it: each test runs it in a folder of its own.

mod displays;
mod errors;
mod files;
mod inspect;
mod program;
mod render;
