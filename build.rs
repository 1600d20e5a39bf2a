//! Notes the commit that is built, for the figures that a study publishes: `GA_PHYSICS_COMMIT`, absent outside a checkout.

use std::process::Command;

fn main() {
    println!("cargo::rerun-if-env-changed=GA_PHYSICS_COMMIT");
    println!("cargo::rerun-if-changed=.git/HEAD");
    println!("cargo::rerun-if-changed=.git/index");
    if std::env::var_os("GA_PHYSICS_COMMIT").is_some() {
        return;
    }
    let describe = Command::new("git").args(["describe", "--always", "--dirty", "--abbrev=12", "--exclude=*"]).output();
    let text = describe.ok().filter(|output| output.status.success()).map(|output| output.stdout);
    if let Some(Ok(commit)) = text.map(String::from_utf8) {
        println!("cargo::rustc-env=GA_PHYSICS_COMMIT={}", commit.trim());
    }
}
