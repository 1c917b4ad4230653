//! Completions and manual pages.

use crate::program::Folder;

#[test]
fn completions_and_pages_know_the_commands() {
    let folder = Folder::new();
    let script = String::from_utf8(folder.succeed(&["completions", "bash"]).stdout).unwrap();
    assert!(
        script.contains("scanray-lab") && script.contains("wait-states"),
        "{script}"
    );
    let page = String::from_utf8(folder.succeed(&["man"]).stdout).unwrap();
    assert!(
        page.contains(".SH EXAMPLES\n") && page.contains("scanray\\-lab"),
        "{page}"
    );
    folder.succeed(&["man", "-o", "."]);
    let names = ["", "-completions", "-man", "-report", "-stability", "-tune"];
    let pages = names.map(|name| format!("scanray-lab{name}.1"));
    assert_eq!(folder.names(), {
        let mut pages = pages.to_vec();
        pages.sort();
        pages
    });
}
