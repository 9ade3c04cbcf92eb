//! docs/methods.md is what the registry says.

#[path = "../examples/make_methods_page.rs"]
mod page;

#[test]
fn the_page_of_methods_is_up_to_date() {
    let stored = std::fs::read_to_string("docs/methods.md").unwrap();
    let page = page::page().unwrap();
    assert!(stored == page, "docs/methods.md is stale: cargo run --example make_methods_page");
}
