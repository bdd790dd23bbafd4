//! Running the built program.

use std::env;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use crate::database_url;

/// What a finished run left.
#[derive(Debug)]
pub struct Run {
    /// Its exit status; `None` if a signal ended it.
    pub status: Option<i32>,
    /// What it printed.
    pub stdout: String,
    /// What it complained about.
    pub stderr: String,
}

impl Run {
    /// Panics with all output unless the program ended with this status.
    #[track_caller]
    pub fn expect(self, status: i32) -> Self {
        assert_eq!(
            self.status,
            Some(status),
            "stdout:\n{}\nstderr:\n{}",
            self.stdout,
            self.stderr
        );
        self
    }

    /// The JSON that it printed.
    #[track_caller]
    #[must_use]
    pub fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|error| panic!("{error}: {self:?}"))
    }
}

/// Runs a command of the program against the test database.
#[track_caller]
pub fn occlusion(arguments: &[&str]) -> Run {
    finished(&mut command(binary(), arguments))
}

/// The same with the program that has item buffers of Embree, `OCCLUSION_EMBREE_BIN`.
///
/// # Panics
/// When that does not say where it is.
#[track_caller]
pub fn occlusion_with_embree(arguments: &[&str]) -> Run {
    let path = env::var_os("OCCLUSION_EMBREE_BIN");
    let path = path.expect("OCCLUSION_EMBREE_BIN is the program that scripts/build-embree makes");
    finished(&mut command(path.into(), arguments))
}

#[track_caller]
fn finished(command: &mut Command) -> Run {
    let output = command.output().expect("the program starts");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    Run {
        status: output.status.code(),
        stdout: text(&output.stdout),
        stderr: text(&output.stderr),
    }
}

/// Runs a whole command line of the program, as it was printed, in a shell and a folder.
#[track_caller]
#[must_use]
pub fn shell(line: &str, folder: &Path) -> Run {
    let mut command = Command::new("sh");
    command.args([
        "-c",
        &format!("occlusion() {{ {:?} \"$@\"; }}; {line}", binary()),
    ]);
    finished(command.current_dir(folder))
}

/// Starts a command of the program against the test database.
#[track_caller]
pub fn start(arguments: &[&str]) -> Child {
    let mut command = command(binary(), arguments);
    command
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts")
}

fn command(program: PathBuf, arguments: &[&str]) -> Command {
    let mut command = Command::new(program);
    command.args(arguments);
    if !arguments.contains(&"--database") {
        command.args(["--database", &database_url()]);
    }
    command
}

/// The program under test: `OCCLUSION_BIN`, or the one built beside this test program.
fn binary() -> PathBuf {
    if let Some(path) = env::var_os("OCCLUSION_BIN") {
        return path.into();
    }
    let tests = env::current_exe().expect("the test program has a path");
    let name = format!("occlusion{}", env::consts::EXE_SUFFIX);
    let mut folders = tests.ancestors().map(|folder| folder.join(&name));
    folders
        .find(|path| path.is_file())
        .expect("the program is built: cargo build --release -p cli")
}
