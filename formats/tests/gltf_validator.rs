//! What is written is valid by the Khronos validator.

mod gltf_scenes;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use formats::{Model, write_glb};
use gltf_scenes::{FAR, building, courtyard, delft, instances, model, painted, thousand};

/// A folder of a test's own, gone at its end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("{name}-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a temporary folder");
        Self(folder)
    }

    fn write(&self, name: &str, bytes: &[u8]) -> PathBuf {
        let path = self.0.join(name);
        std::fs::write(&path, bytes).expect("room for a file");
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn validate(files: &[PathBuf]) -> Output {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scripts/validate-glb");
    Command::new(script)
        .args(files)
        .output()
        .expect("the script runs")
}

#[test]
fn written_files_are_valid() {
    let mut everything = thousand();
    everything.extend(instances());
    everything.extend([painted(-1), courtyard(-2), model(-3, Vec::new())]);
    let scenes: [(&str, Vec<Model>, Option<i32>); 8] = [
        ("empty", Vec::new(), None),
        ("empty with srid", Vec::new(), Some(28992)),
        ("box", vec![building(7, FAR)], Some(28992)),
        ("materials", vec![painted(1)], None),
        ("holes", vec![courtyard(2)], None),
        ("instances", instances(), None),
        ("delft", delft(), Some(7415)),
        ("everything", everything, Some(7415)),
    ];
    let folder = Folder::new("gltf-validator");
    let files: Vec<_> = scenes
        .iter()
        .map(|(name, models, srid)| {
            let bytes = write_glb(models, *srid).unwrap_or_else(|error| panic!("{name}: {error}"));
            folder.write(&format!("{name}.glb"), &bytes)
        })
        .collect();
    let output = validate(&files);
    let text = String::from_utf8_lossy(&output.stdout);
    let complaints = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}{complaints}");
    let clean = text
        .lines()
        .filter(|line| line.ends_with(".glb: 0 errors, 0 warnings"));
    assert_eq!(clean.count(), files.len(), "{text}{complaints}");
}

#[test]
fn the_script_fails_on_what_is_not_valid() {
    let folder = Folder::new("gltf-invalid");
    let mut bytes = write_glb(&[building(7, FAR)], None).expect("a file");
    let at = bytes
        .windows(6)
        .position(|w| w == b"\"VEC3\"")
        .expect("positions");
    bytes[at + 4] = b'4';
    let output = validate(&[folder.write("broken.glb", &bytes)]);
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(!output.status.success(), "{text}");
    assert!(text.contains(": error: "), "{text}");
}
