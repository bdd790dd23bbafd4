//! Pictures: given pixels have given colours, and everything is where the scene says.

use renderer::{
    Area, Error, Image, Observer, PictureCell, PictureColumn, PictureFeature, PictureScene,
    PlanView, Renderer, Sight, Status, View, heat_map, plan, sight_map,
};
use std::sync::LazyLock;

static RENDERER: LazyLock<Renderer> = LazyLock::new(|| Renderer::new().unwrap());

const GREEN: [u8; 3] = [43, 164, 125];
const RED: [u8; 3] = [214, 92, 62];
const BLUE: [u8; 3] = [58, 116, 190];
const STREET: [u8; 3] = [225, 228, 231];
const PAPER: [u8; 3] = [248, 246, 241];

/// A box with a lower corner and a size, as twelve triangles of mixed windings.
fn house(status: Status, low: [f64; 3], size: [f64; 3]) -> PictureFeature {
    let corner = |i: usize| -> [f64; 3] {
        std::array::from_fn(|axis| low[axis] + if i >> axis & 1 == 1 { size[axis] } else { 0.0 })
    };
    let faces = [
        [0, 1, 3, 2],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 3, 7, 6],
        [0, 2, 6, 4],
        [1, 3, 7, 5],
    ];
    let triangles = faces
        .iter()
        .flat_map(|f| [[f[0], f[1], f[2]], [f[0], f[2], f[3]]]);
    PictureFeature {
        status,
        triangles: triangles.map(|t| t.map(corner)).collect(),
        columns: vec![],
    }
}

/// Four houses around a street, at map coordinates. The observer looks north.
fn scene() -> PictureScene {
    let [x, y] = [85_000.0, 447_000.0];
    let square = |at: [f64; 2], half: f64| {
        vec![
            [at[0] - half, at[1] - half],
            [at[0] + half, at[1] - half],
            [at[0] + half, at[1] + half],
            [at[0] - half, at[1] + half],
        ]
    };
    PictureScene {
        title: "Four houses".into(),
        subtitle: "an observer looks north".into(),
        attribution: "made up".into(),
        features: vec![
            house(
                Status::Visible,
                [x - 10.0, y + 20.0, 0.0],
                [20.0, 10.0, 15.0],
            ),
            house(Status::Hidden, [x - 5.0, y + 40.0, 0.0], [10.0, 10.0, 6.0]),
            house(
                Status::OverEstimated,
                [x - 5.0, y + 60.0, 0.0],
                [10.0, 10.0, 5.0],
            ),
            house(
                Status::Outside,
                [x - 10.0, y - 40.0, 0.0],
                [20.0, 10.0, 9.0],
            ),
        ],
        streets: vec![Area {
            exterior: square([x + 40.0, y + 10.0], 20.0),
            holes: vec![square([x + 40.0, y + 10.0], 8.0)],
        }],
        rectangles: vec![([x - 44.0, y - 40.0], [x - 24.0, y - 20.0])],
        observer: Some(Observer {
            eye: [x, y, 1.75],
            heading: 0.0,
            angle: 60.0,
            range: 80.0,
        }),
    }
}

/// The plan of 100 x 125 m at 4 pixels a metre, beside a legend of 240 pixels or more.
struct Plan(Image);

impl Plan {
    const WIDTH: u32 = 1000;
    const HEIGHT: u32 = 500;

    const VIEW: PlanView = PlanView {
        width: Self::WIDTH,
        height: Self::HEIGHT,
        window: Some(([84_950.0, 446_950.0], [85_050.0, 447_075.0])),
    };

    fn of(scene: &PictureScene) -> Self {
        Self(plan(scene, &Self::VIEW).unwrap())
    }

    /// How many pixels of a colour there are in the column beside the map.
    fn beside(&self, color: [u8; 3]) -> usize {
        pixels(&self.0)
            .filter(|&(x, _, c)| x > 770 && c == color)
            .count()
    }

    /// The colour at a place, relative to the observer. The map's middle is x = 0, y = 12.5.
    fn at(&self, x: f64, y: f64) -> [u8; 3] {
        let unit: f64 = 500.0 / 800.0;
        let map = f64::from(Self::WIDTH) - (0.24 * 1000.0_f64).clamp(150.0 * unit, 290.0 * unit);
        let right = map / 2.0 + 4.0 * x;
        let down = 250.0 - 4.0 * (y - 12.5);
        rgb(&self.0, right as u32, down as u32)
    }
}

fn rgb(image: &Image, x: u32, y: u32) -> [u8; 3] {
    let [r, g, b, a] = image.pixel(x, y).unwrap();
    assert_eq!(a, 255);
    [r, g, b]
}

fn pixels(image: &Image) -> impl Iterator<Item = (u32, u32, [u8; 3])> {
    let at = |i: u32| (i % image.width(), i / image.width());
    (0..image.width() * image.height()).map(move |i| {
        let (x, y) = at(i);
        (x, y, rgb(image, x, y))
    })
}

#[test]
fn a_plan_shows_each_status_in_its_colour() {
    let plan = Plan::of(&scene());
    assert_eq!(plan.at(5.0, 25.0), GREEN);
    assert_eq!(plan.at(2.0, 43.0), RED);
    assert_eq!(plan.at(3.0, 64.0 - 3.0), BLUE);
    let outside = plan.at(5.0, -35.0);
    assert!(
        outside[0].abs_diff(outside[2]) < 20 && outside[0] > 200,
        "{outside:?}"
    );
    assert_eq!(plan.at(-40.0, 40.0), PAPER);
}

#[test]
fn a_plan_shows_streets_with_their_holes() {
    let plan = Plan::of(&scene());
    assert_eq!(plan.at(55.0, 10.0), STREET);
    assert_eq!(plan.at(40.0, 10.0), PAPER);
}

#[test]
fn a_plan_tints_the_field_of_view_and_the_volumes() {
    let plan = Plan::of(&scene());
    let [r, _, b] = plan.at(4.0, 15.0);
    assert!(r > b + 30, "the field of view is warm");
    assert_eq!(plan.at(-12.0, 8.0), PAPER, "beside the sector");
    let [r, g, b] = plan.at(-34.0, -30.0);
    assert!(b > g && r > g, "volumes are violet");
    let mark = plan.at(0.0, 0.0);
    assert!(
        mark.iter().all(|&channel| channel < 60),
        "the observer is dark: {mark:?}"
    );
    let pointer = plan.at(0.0, 3.0);
    assert!(
        pointer.iter().all(|&channel| channel < 60),
        "it points north: {pointer:?}"
    );
}

#[test]
fn footprints_have_no_seams_and_a_dark_outline() {
    let plan = Plan::of(&scene());
    for step in 0..160 {
        for line in 0..72 {
            let (x, y) = (
                -9.5 + f64::from(step) * 0.119,
                20.5 + f64::from(line) * 0.125,
            );
            if !(x.abs() < 2.0 && y < 10.0) {
                assert_eq!(plan.at(x, y), GREEN, "at {x}, {y}");
            }
        }
    }
    let along: Vec<u8> = (0..12)
        .map(|i| plan.at(-11.0 + 0.125 * f64::from(i), 25.0)[1])
        .collect();
    assert!(along.iter().any(|&green| green < 150), "{along:?}");
}

#[test]
fn a_plan_has_its_legend_beside_the_map() {
    let image = Plan::of(&scene()).0;
    assert_eq!((image.width(), image.height()), (Plan::WIDTH, Plan::HEIGHT));
    for color in [GREEN, RED, BLUE] {
        let swatch = pixels(&image)
            .filter(|&(x, _, c)| x > 830 && c == color)
            .count();
        assert!((20..200).contains(&swatch), "{swatch} pixels of {color:?}");
    }
    let ink = pixels(&image)
        .filter(|&(x, _, c)| x > 830 && c[0] < 60 && c[2] < 70)
        .count();
    assert!(ink > 150, "{ink} pixels of text");
    let bare = Plan::of(&PictureScene::default()).0;
    assert!(pixels(&bare).all(|(x, _, c)| x < 830 || (c != RED && c != BLUE)));
}

#[test]
fn a_plan_of_nothing_is_paper() {
    let view = PlanView {
        width: 300,
        height: 200,
        window: None,
    };
    let image = plan(&PictureScene::default(), &view).unwrap();
    assert_eq!(rgb(&image, 50, 100), PAPER);
}

#[test]
fn a_plan_holds_the_whole_scene() {
    let image = plan(
        &scene(),
        &PlanView {
            width: 800,
            height: 600,
            window: None,
        },
    )
    .unwrap();
    let map = |color| {
        pixels(&image)
            .filter(|&(x, _, c)| x < 580 && c == color)
            .count()
    };
    assert!(map(GREEN) > 1000 && map(RED) > 500 && map(BLUE) > 500);
}

#[test]
fn broken_coordinates_are_left_out_of_pictures() {
    let mut broken = scene();
    broken.features[0].triangles[0][0][0] = f64::NAN;
    broken.features[1].triangles[3][1][2] = f64::INFINITY;
    broken.streets[0].exterior[2][1] = f64::NAN;
    assert_eq!(Plan::of(&broken).at(5.0, 25.0), GREEN);
    let view = View::from_above(&broken, 160, 100);
    assert!(RENDERER.perspective(&broken, &view).is_ok());
}

#[test]
fn impossible_plans_are_refused() {
    let sized = |width, height| {
        plan(
            &scene(),
            &PlanView {
                width,
                height,
                window: None,
            },
        )
    };
    assert!(matches!(sized(0, 100), Err(Error::View(_))));
    assert!(
        sized(100_000, 100)
            .unwrap_err()
            .to_string()
            .contains("100000")
    );
    for corner in [[0.0, 0.0], [f64::NAN, 9.0], [f64::INFINITY, 1.0]] {
        let view = PlanView {
            width: 90,
            height: 90,
            window: Some(([0.0, 0.0], corner)),
        };
        assert!(matches!(plan(&scene(), &view), Err(Error::View(_))));
    }
}

/// The ends of viridis, and the middle of it.
const DARKEST: [u8; 3] = [68, 1, 84];
const MIDDLE: [u8; 3] = [32, 144, 140];
const LIGHTEST: [u8; 3] = [253, 231, 37];
const GREY: [u8; 3] = [198, 196, 192];

/// A view cell around a place relative to the observer.
fn cell<T>([x, y]: [f64; 2], half: f64, told: T) -> PictureCell<T> {
    let corner = |step: f64| [85_000.0 + x + step, 447_000.0 + y + step];
    PictureCell {
        rectangle: (corner(-half), corner(half)),
        told,
    }
}

#[test]
fn a_heat_map_shows_each_number_in_its_colour() {
    let cells = [
        cell([-34.0, -30.0], 10.0, 100),
        cell([-10.0, 8.0], 4.0, 50),
        cell([-34.0, -30.0], 10.0, 0),
        cell([-34.0, 10.0], 10.0, 0),
        cell([-5.0, 25.0], 2.0, 100),
    ];
    let map = Plan(heat_map(&scene(), &cells, "Features", &Plan::VIEW).unwrap());
    // The greatest number is on top, wherever it stands among the cells.
    assert_eq!(map.at(-34.0, -30.0), LIGHTEST);
    assert_eq!(map.at(-34.0, 10.0), DARKEST);
    assert_eq!(map.at(-10.0, 8.0), MIDDLE);
    assert_eq!(map.at(-5.0, 25.0), GREY, "features stand over cells");
    assert_eq!(map.at(2.0, 43.0), GREY, "of any status");
    // To the pixel, without a soft edge.
    assert_eq!(map.at(-43.9, -20.2), LIGHTEST);
    assert_eq!(map.at(-44.3, -20.2), PAPER);
    assert_eq!(map.at(-43.9, -19.7), PAPER);
    for color in [DARKEST, MIDDLE, LIGHTEST] {
        let near = |c: [u8; 3]| (0..3).all(|i| c[i].abs_diff(color[i]) < 6);
        let bar = pixels(&map.0).filter(|&(x, _, c)| x > 770 && near(c));
        assert!(bar.count() > 10, "{color:?} is on the bar");
    }
    assert!(map.beside(STREET) > 20, "no cell is on the street");
}

#[test]
fn a_heat_map_scales_to_what_it_shows() {
    let mut cells = vec![
        cell([-34.0, 10.0], 10.0, 40),
        cell([-34.0, -30.0], 10.0, 60),
    ];
    let image = |cells: &[_]| heat_map(&scene(), cells, "Features", &Plan::VIEW).unwrap();
    let alone = image(&cells);
    cells.push(cell([900.0, 0.0], 10.0, 100_000));
    cells.push(cell([f64::NAN, 0.0], 10.0, 100_000));
    assert_eq!(image(&cells), alone);
    assert_eq!(Plan(alone).at(-34.0, -30.0), LIGHTEST);
    let empty = Plan(image(&[]));
    assert_eq!(empty.at(-34.0, -30.0), PAPER);
    assert_eq!(empty.at(55.0, 10.0), STREET);
    // The street goes on where the map ends, and the cell with it.
    let window = Some(([84_990.0, 446_990.0], [85_030.0, 447_010.0]));
    let view = PlanView {
        window,
        ..Plan::VIEW
    };
    let covered = [cell([40.0, 10.0], 60.0, 7)];
    let map = Plan(heat_map(&scene(), &covered, "Features", &view).unwrap());
    assert_eq!(map.beside(STREET), 0);
}

#[test]
fn a_map_of_sight_shows_from_where_a_feature_is_seen() {
    const PROVEN: [u8; 3] = [20, 98, 160];
    const POSSIBLE: [u8; 3] = [128, 186, 226];
    const UNSEEN: [u8; 3] = [233, 236, 238];
    const SUBJECT: [u8; 3] = [213, 94, 0];
    let cells = [
        cell([-34.0, 40.0], 6.0, Sight::Proven),
        cell([-34.0, 10.0], 6.0, Sight::Possible),
        cell([-34.0, -30.0], 6.0, Sight::Hidden),
        cell([40.0, 10.0], 21.0, Sight::Hidden),
    ];
    let map = Plan(sight_map(&scene(), 1, &cells, &Plan::VIEW).unwrap());
    assert_eq!(map.at(-34.0, 40.0), PROVEN);
    assert_eq!(map.at(-34.0, 10.0), POSSIBLE);
    assert_eq!(map.at(-34.0, -30.0), UNSEEN);
    assert_eq!(map.at(2.0, 43.0), SUBJECT);
    assert_eq!(map.at(5.0, 25.0), GREY);
    // The corner of the feature is 7.1 m from its middle, and the ring is 6 points around.
    let ring = (0..12).map(|step| map.at(7.0 + 0.25 * f64::from(step), 45.0));
    assert!(ring.into_iter().any(|color| color == SUBJECT));
    for color in [PROVEN, POSSIBLE, UNSEEN, SUBJECT, GREY] {
        assert!(
            (20..200).contains(&map.beside(color)),
            "{color:?} is in the legend"
        );
    }
    assert_eq!(map.beside(STREET), 0, "all streets have cells");
    let fewer = Plan(sight_map(&scene(), 1, &cells[..1], &Plan::VIEW).unwrap());
    assert_eq!(fewer.beside(POSSIBLE), 0);
    assert!(fewer.beside(STREET) > 20);
}

/// How far a colour leans to one of the three channels.
fn leans([r, g, b]: [u8; 3], to: usize) -> bool {
    let channels = [r, g, b].map(i32::from);
    (0..3).all(|other| other == to || channels[to] > channels[other] + 25)
}

#[test]
fn from_the_observers_eye_only_the_front_house_is_seen() {
    let scene = scene();
    let view = View::from_observer(&scene.observer.unwrap(), 640, 400);
    let image = RENDERER.perspective(&scene, &view).unwrap();
    assert_eq!((image.width(), image.height()), (640, 400));
    assert!(
        leans(rgb(&image, 320, 195), 1),
        "{:?}",
        rgb(&image, 320, 195)
    );
    let sky = rgb(&image, 500, 8);
    assert!(sky[2] > sky[0], "{sky:?}");
    let card = |x: u32, y: u32| x < 170 && y < 200;
    assert!(
        pixels(&image).all(|(x, y, c)| card(x, y) || !leans(c, 0)),
        "red is hidden"
    );
    assert!(
        pixels(&image).any(|(x, y, c)| card(x, y) && leans(c, 0)),
        "red is in the legend"
    );
}

#[test]
fn from_above_all_are_seen() {
    let scene = scene();
    let view = View::from_above(&scene, 640, 400);
    let image = RENDERER.perspective(&scene, &view).unwrap();
    for channel in 0..3 {
        let count = pixels(&image)
            .filter(|&(x, _, c)| x > 180 && leans(c, channel))
            .count();
        assert!(count > 60, "{count} pixels lean to channel {channel}");
    }
}

#[test]
fn houses_cast_shadows_on_lit_ground() {
    let [x, y] = [85_000.0, 447_000.0];
    let features = vec![house(
        Status::Outside,
        [x - 5.0, y - 5.0, 0.0],
        [10.0, 10.0, 20.0],
    )];
    let scene = PictureScene {
        features,
        ..Default::default()
    };
    let view = View {
        eye: [x, y, 200.0],
        target: [x, y, 0.0],
        vertical_angle: 40.0,
        width: 400,
        height: 400,
    };
    let image = RENDERER.perspective(&scene, &view).unwrap();
    let light = |x: u32, y: u32| rgb(&image, x, y).map(u32::from).iter().sum::<u32>();
    // North is up; the sun stands in the south-east, so the shadow falls to the north-west.
    let (north_west, south_east) = (light(178, 170), light(222, 230));
    assert!(north_west + 90 < south_east, "{north_west} {south_east}");
}

/// A house of 20 x 20 x 12 m with these columns, seen from the south above.
fn looked_into(columns: Vec<PictureColumn>) -> Image {
    let low = [84_990.0, 446_990.0, 0.0];
    let glass = house(Status::Outside, low, [20.0, 20.0, 12.0]);
    let scene = PictureScene {
        features: vec![PictureFeature { columns, ..glass }],
        ..Default::default()
    };
    let view = View::from_above(&scene, 400, 300);
    RENDERER.columns(&scene, &view).unwrap()
}

/// A square column around the middle of the house.
fn column(half: f64, [bottom, top]: [f64; 2], grounded: bool) -> PictureColumn {
    let square = [[-half, -half], [half, -half], [half, half], [-half, half]];
    let exterior = square.map(|[x, y]| [85_000.0 + x, 447_000.0 + y]).to_vec();
    let holes = vec![];
    PictureColumn {
        footprint: Area { exterior, holes },
        bottom,
        top,
        grounded,
    }
}

/// Pixels of orange and of purple beside the legend.
fn orange_and_purple(image: &Image) -> [usize; 2] {
    let is_purple = |[r, g, b]: [u8; 3]| r.min(b) > g.saturating_add(15) && r.abs_diff(b) < 25;
    let beside = || pixels(image).filter(|&(x, y, _)| x > 125 || y > 100);
    let orange = beside().filter(|&(.., c)| leans(c, 0)).count();
    [orange, beside().filter(|&(.., c)| is_purple(c)).count()]
}

#[test]
fn columns_are_seen_inside_glass() {
    let empty = looked_into(vec![]);
    assert_eq!(orange_and_purple(&empty), [0, 0]);
    let grounded = looked_into(vec![column(6.0, [0.0, 9.0], true)]);
    let [orange, purple] = orange_and_purple(&grounded);
    assert!(orange > 2000 && purple == 0, "{orange} {purple}");
    let raised = looked_into(vec![column(6.0, [3.0, 9.0], false)]);
    let [orange, purple] = orange_and_purple(&raised);
    assert!(orange == 0 && purple > 2000, "{orange} {purple}");
    let [glass, ground] = [[200, 250], [10, 290]].map(|[x, y]| rgb(&grounded, x, y));
    assert_eq!(glass, rgb(&empty, 200, 250));
    assert!(
        glass[2] > ground[2] - 20 && glass[0] + 5 < ground[0],
        "{glass:?} {ground:?}"
    );
}

#[test]
fn nested_columns_are_told_apart() {
    let levels = [8.0, 4.0].map(|half| column(half, [0.0, 9.0 - half / 16.0], true));
    let lines = |columns: &[PictureColumn]| {
        let image = looked_into(columns.to_vec());
        let light = |y| rgb(&image, 200, y).map(i32::from).iter().sum::<i32>();
        let is_line = |&y: &u32| light(y) + 20 < light(y - 3).min(light(y + 3));
        // The upper edge of the top, with no wall beside it.
        (5..60).filter(is_line).count()
    };
    assert_eq!(lines(&levels[..1]), 0);
    assert!(lines(&levels) > 0);
}

#[test]
fn broken_columns_are_left_out() {
    let mut broken = column(6.0, [0.0, 9.0], true);
    broken.footprint.exterior[1][0] = f64::NAN;
    let endless = column(6.0, [0.0, f64::INFINITY], true);
    let image = looked_into(vec![broken, endless]);
    assert_eq!(orange_and_purple(&image), [0, 0]);
}

#[test]
fn impossible_cameras_are_refused() {
    let scene = scene();
    let good = View::from_above(&scene, 64, 48);
    let refused = |view: View| RENDERER.perspective(&scene, &view).unwrap_err();
    assert!(matches!(
        refused(View {
            target: good.eye,
            ..good
        }),
        Error::View(_)
    ));
    assert!(matches!(
        refused(View { width: 0, ..good }),
        Error::Resolution { .. }
    ));
    assert!(matches!(
        refused(View {
            height: u32::MAX,
            ..good
        }),
        Error::Resolution { .. }
    ));
    assert!(matches!(
        refused(View {
            vertical_angle: 0.0,
            ..good
        }),
        Error::View(_)
    ));
}
