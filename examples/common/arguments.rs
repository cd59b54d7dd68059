//! Command-line arguments of the examples, which are all paths.

use std::path::PathBuf;
use std::process::exit;

/// The paths on the command line, at most `N`, in the order in which `usage` names them. For `--help` the program
/// prints its usage and ends; for other options it prints an error and ends with code 2.
pub fn paths<const N: usize>(usage: &str) -> [Option<PathBuf>; N] {
    let mut paths = [const { None }; N];
    let mut free = paths.iter_mut();
    for argument in std::env::args_os().skip(1) {
        if argument == "--help" || argument == "-h" {
            println!("Usage: {usage}");
            exit(0);
        }
        let is_option = argument.as_encoded_bytes().starts_with(b"-");
        match free.next().filter(|_| !is_option) {
            Some(path) => *path = Some(argument.into()),
            None => {
                eprintln!("unexpected argument {argument:?}; usage: {usage}");
                exit(2);
            }
        }
    }
    paths
}
