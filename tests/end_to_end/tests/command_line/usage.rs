//! Wrong usage and missing servers.

use end_to_end::{TestScene, occlusion};

#[test]
fn wrong_usage_exits_with_2() {
    for arguments in [
        &["import"][..],
        &["fly"],
        &["query", "x", "--observer", "1,2"],
        &["query", "x", "--observer", "1,2,3", "--heading", "4"],
        &["query", "x", "--observer", "1,2,3", "--fov", "60"],
        &[
            "query",
            "x",
            "--observer",
            "1,2,3",
            "--heading",
            "4",
            "--fov",
            "60",
            "--angle",
            "60",
        ],
        &[
            "query",
            "x",
            "--observer",
            "1,2,3",
            "--heading",
            "4",
            "--fov",
            "60",
            "--sector",
        ],
        &["verify", "x", "--resolution", "0"],
        &["bench"],
        &["bench", "index", "--rows", "0"],
        &["bench", "cells", "x", "--edge", "0"],
        &["bench", "edits", "x", "--rows", "0"],
        &["render", "x", "--observer", "1,2,3", "--size", "big"],
        &["render", "x"],
        &["render", "x", "--cells", "--plan"],
        &["render", "x", "--cells", "--range", "9"],
        &["render", "x", "--observer", "1,2,3", "--feature", "4"],
    ] {
        occlusion(arguments).expect(2);
    }
}

#[test]
fn help_has_examples_and_exit_statuses() {
    for command in [
        "import",
        "generate",
        "query",
        "verify",
        "render",
        "bench index",
        "bench cells",
        "bench edits",
    ] {
        let mut arguments: Vec<&str> = command.split(' ').collect();
        arguments.extend(["--help", "--database", "x"]);
        let help = occlusion(&arguments).expect(0).stdout;
        assert!(help.contains(&format!("occlusion {command} ")), "{help}");
        assert!(
            help.contains("Exit status:") && help.contains("Examples:"),
            "{help}"
        );
    }
}

#[test]
fn a_missing_server_exits_with_3() {
    let nowhere = "postgresql://postgres@/x?host=%2Fno%2Fsuch%2Fsocket";
    let run = occlusion(&["generate", "x", "--database", nowhere]).expect(3);
    assert!(
        run.stderr.contains("error:") && run.stderr.contains("connect"),
        "{}",
        run.stderr
    );
    let run = occlusion(&["generate", "x", "--database", "port=x"]).expect(2);
    assert!(
        run.stderr.contains("\"port=x\" is no database"),
        "{}",
        run.stderr
    );
}

#[test]
fn a_missing_scene_exits_with_3_and_says_so() {
    let scene = TestScene::new("missing");
    for command in ["generate", "verify"] {
        let run = occlusion(&[command, &scene.name]).expect(3);
        let expected = format!("scene \"{}\" does not exist", scene.name);
        assert!(run.stderr.contains(&expected), "{}", run.stderr);
    }
}
