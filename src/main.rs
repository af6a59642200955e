//! The `shelter` program; see the library for everything it does.

fn main() -> std::process::ExitCode {
    shelter::cli::run()
}
