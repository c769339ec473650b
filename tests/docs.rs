//! README and the pages of docs: what they link to is there, and their pictures are made by a script.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The files of a folder with this extension.
fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a readable folder");
    let paths = entries.map(|entry| entry.expect("a readable entry").path());
    paths.filter(|path| path.extension().is_some_and(|found| found == extension)).collect()
}

/// README, CONTRIBUTING, CHANGELOG and the pages of docs.
fn pages() -> Vec<PathBuf> {
    [files(root(), "md"), files(&root().join("docs"), "md")].concat()
}

/// Where a page's links to files lead.
fn links(page: &Path) -> BTreeSet<PathBuf> {
    let text = read(page);
    let targets = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    let paths = targets.filter_map(|target| target.split('#').next());
    let files = paths.filter(|path| !path.is_empty() && !path.starts_with("http"));
    files
        .map(|path| page.parent().expect("a folder").join(path))
        .map(|path| {
            path.canonicalize()
                .unwrap_or_else(|_| panic!("{}: there is no {}", page.display(), path.display()))
        })
        .collect()
}

fn canonical(path: &Path) -> PathBuf {
    path.canonicalize().expect("it is there")
}

/// Catches a page that no newcomer finds, and a link that leads nowhere.
#[test]
fn readme_leads_to_every_page() {
    let linked = links(&root().join("README.md"));
    for page in pages() {
        links(&page);
        let is_readme = page.ends_with("README.md");
        assert!(is_readme || linked.contains(&canonical(&page)), "no link to {}", page.display());
    }
    assert!(linked.len() > 8, "{linked:?}");
    let lines = read(&root().join("README.md")).lines().count();
    assert!(lines <= 150, "README has {lines} lines: what is not for newcomers has pages of its own");
}

/// The pictures that a script, or the commands that stand under the pictures of a page, write.
fn made() -> BTreeSet<PathBuf> {
    let images = root().join("docs/images");
    let mut made = BTreeSet::new();
    for script in files(&root().join("scripts"), "sh") {
        let text = read(&script);
        for line in text.lines().filter(|line| !line.starts_with('#')) {
            made.extend(line.strip_prefix("save ").map(|name| images.join(name)));
        }
        made.extend(written(&text));
    }
    for page in pages() {
        made.extend(written(&read(&page)));
    }
    made
}

/// What the commands in a text write to docs/images: the last word of each.
fn written(text: &str) -> Vec<PathBuf> {
    let words = text.lines().filter_map(|line| line.trim_end_matches(['`', '*']).rsplit(' ').next());
    let paths = words.filter_map(|word| word.trim_start_matches("PNG8:").strip_prefix("docs/images/"));
    paths.filter(|name| name.ends_with(".png")).map(|name| root().join("docs/images").join(name)).collect()
}

/// Catches a picture that was made by hand, and one that no page shows any more.
#[test]
fn every_picture_is_shown_and_made_by_a_script() {
    let shown: BTreeSet<PathBuf> = pages().iter().flat_map(|page| links(page)).collect();
    let is_png = |path: &&PathBuf| path.extension().is_some_and(|extension| extension == "png");
    let shown: BTreeSet<PathBuf> = shown.iter().filter(is_png).cloned().collect();
    let made: BTreeSet<PathBuf> = made().iter().map(|path| canonical(path)).collect();
    let there: BTreeSet<PathBuf> =
        files(&root().join("docs/images"), "png").iter().map(|path| canonical(path)).collect();
    assert_eq!(shown, there, "pictures that pages show, and those that are there");
    assert_eq!(made, there, "pictures that are made, and those that are there");
    assert!(there.len() > 10, "{there:?}");
}
