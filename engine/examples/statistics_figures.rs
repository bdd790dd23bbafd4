//! How well the planner's statistics estimate: for several kinds of boxes and queries, the share
//! of 1,000 queries that hold 0.1 to 10 % of the rows and are estimated within a factor of 2, and
//! of the smaller ones within a factor of 5 or 50 rows.
//!
//!     cargo run --release -p engine --example statistics_figures [ROWS] [GROUPS]
//!
//! with ROWS boxes of each kind, of which 30,000 are sampled, in GROUPS groups.

use engine::{Box3d, BoxRelation, BoxStatistics, CityLayout, ViewCone, ViewSector, generated_city};
use glam::DVec3;
use std::time::Instant;

/// What ANALYZE samples at PostgreSQL's default statistics target.
const SAMPLE: usize = 30_000;
/// Queries of each kind.
const QUERIES: usize = 1_000;

/// Linear congruential numbers in [0, 1), the same everywhere.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn point(&mut self) -> DVec3 {
        DVec3::new(self.unit(), self.unit(), self.unit())
    }

    /// About normal, of deviation 1.
    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.unit()).sum::<f64>() - 6.0
    }
}

/// The kinds of boxes.
fn kinds(rows: usize) -> Vec<(&'static str, Vec<Box3d>)> {
    let mut random = Random(1);
    let extent = DVec3::new(10_000.0, 10_000.0, 60.0);
    let mut boxes = |make: &mut dyn FnMut(&mut Random) -> Box3d| -> Vec<Box3d> {
        (0..rows).map(|_| make(&mut random)).collect()
    };
    let uniform = boxes(&mut |r| {
        let corner = r.point() * extent;
        Box3d::new(corner, corner + r.point() * DVec3::new(20.0, 20.0, 30.0))
    });
    let mut centre = Random(7);
    let centres: Vec<DVec3> = (0..30).map(|_| centre.point() * extent).collect();
    let clustered = boxes(&mut |r| {
        let centre = centres[(r.unit().powi(2) * 30.0) as usize];
        let spread = DVec3::new(r.normal(), r.normal(), 0.1 * r.normal()) * 200.0;
        let corner = centre + spread;
        Box3d::new(corner, corner + r.point() * 15.0)
    });
    let city = |layout| -> Vec<Box3d> {
        let made: Vec<_> = generated_city(layout, rows.min(100_000), 1)
            .features()
            .map(|f| f.envelope)
            .collect();
        made
    };
    let volumes = |depth: f64| {
        move |r: &mut Random| {
            let corner = DVec3::new(r.unit() * 10_000.0, (r.unit() * 40.0).floor() * 250.0, 1.5);
            let size = DVec3::new(depth * 0.05 * r.unit(), 8.0 * r.unit(), 0.5);
            Box3d::new(corner, corner + size)
        }
    };
    let far = boxes(&mut |r| {
        let corner = DVec3::new(85_000.0, 447_000.0, 0.0) + r.point() * extent;
        Box3d::new(corner, corner + DVec3::new(10.0, 10.0, 0.0))
    });
    let sizes = boxes(&mut |r| {
        let corner = r.point() * extent;
        let size = 10f64.powf(r.unit() * 3.0);
        Box3d::new(
            corner,
            corner + DVec3::new(size, size * r.unit(), r.unit() * 30.0),
        )
    });
    let volumes_200 = boxes(&mut volumes(200.0));
    let volumes_2000 = boxes(&mut volumes(2_000.0));
    vec![
        ("uniform", uniform),
        ("clustered", clustered),
        ("streets", city(CityLayout::Streets)),
        ("blocks", city(CityLayout::Blocks)),
        ("scattered", city(CityLayout::Scattered)),
        ("flat, far away", far),
        ("all sizes", sizes),
        ("volumes", volumes_200),
        ("long volumes", volumes_2000),
    ]
}

/// How the estimates of some queries compare with the counts.
#[derive(Default)]
struct Score {
    large: [usize; 2],
    small: [usize; 2],
}

impl Score {
    fn add(&mut self, estimate: f64, count: f64, rows: f64) {
        let estimate = estimate.max(1.0).round();
        let ratio = (estimate / count.max(1.0)).max(count / estimate);
        if count >= 0.001 * rows && count <= 0.1 * rows {
            self.large[0] += usize::from(ratio <= 2.0);
            self.large[1] += 1;
        } else if count < 0.001 * rows {
            let good = ratio <= 5.0 || (estimate - count).abs() <= 50.0;
            self.small[0] += usize::from(good);
            self.small[1] += 1;
        }
    }

    fn print(&self) -> String {
        let percent = |[good, all]: [usize; 2]| {
            format!(
                "{:5.1} % of {all:4}",
                100.0 * good as f64 / all.max(1) as f64
            )
        };
        format!("{} {}", percent(self.large), percent(self.small))
    }
}

/// Whether a score has all its queries of one size.
fn full(score: &Score) -> bool {
    score.large[1] >= QUERIES
}

type Query = (
    String,
    Box<dyn Fn(&Box3d) -> bool>,
    Box<dyn Fn(&BoxStatistics) -> f64>,
);

/// Query number of a kind, about `size` of the extent.
fn query(kind: &str, random: &mut Random, boxes: &[Box3d], extent: &Box3d) -> Query {
    let anywhere = extent.min + extent.size() * random.point();
    let some_box = boxes[(random.unit() * boxes.len() as f64) as usize];
    let on_box = some_box.center();
    let centre = if random.unit() < 0.5 {
        on_box
    } else {
        anywhere
    };
    let share = 10f64.powf(-4.0 + 4.0 * random.unit());
    let plan = extent.size().truncate().max_element() * share.sqrt();
    match kind {
        "&& column" | "<@ column" => {
            let aspect = 4f64.powf(random.unit() - 0.5);
            let half = DVec3::new(plan * aspect, plan / aspect, 1e6) / 2.0;
            boxed(kind, Box3d::new(centre - half, centre + half))
        }
        "@> inside" => {
            let half = some_box.size() * 0.5 * random.point() * random.unit();
            boxed(kind, Box3d::new(on_box - half, on_box + half))
        }
        "&& cone" => {
            let cone = ViewCone::new(
                centre,
                6.3 * random.unit(),
                0.2 + 2.0 * random.unit(),
                plan,
                0.0,
            );
            (
                kind.into(),
                Box::new(move |b| cone.meets(b)),
                Box::new(move |s| s.share_meeting(|b| cone.meets(b))),
            )
        }
        "&& sector" => {
            let sector =
                ViewSector::new(centre, 6.3 * random.unit(), 0.2 + 2.0 * random.unit(), plan);
            (
                kind.into(),
                Box::new(move |b| sector.meets(b)),
                Box::new(move |s| s.share_meeting(|b| sector.meets(b))),
            )
        }
        _ => {
            let half = extent.size() * random.point() * share.cbrt() / 2.0;
            boxed(kind, Box3d::new(centre - half, centre + half))
        }
    }
}

fn boxed(kind: &str, query: Box3d) -> Query {
    let relation = match &kind[..2] {
        "@>" => BoxRelation::Contains,
        "<@" => BoxRelation::ContainedBy,
        _ => BoxRelation::Overlaps,
    };
    (
        kind.into(),
        Box::new(move |b| match relation {
            BoxRelation::Contains => b.contains(&query),
            BoxRelation::ContainedBy => query.contains(b),
            _ => b.overlaps(&query),
        }),
        Box::new(move |s| s.share(relation, &query)),
    )
}

fn main() {
    let argument = |at: usize, default: usize| {
        std::env::args()
            .nth(at)
            .and_then(|a| a.parse().ok())
            .unwrap_or(default)
    };
    let (rows, groups) = (argument(1, 100_000), argument(2, 1_600));
    for (name, boxes) in kinds(rows) {
        let mut random = Random(3);
        let mut sample: Vec<Box3d> = boxes.clone();
        let kept = SAMPLE.min(boxes.len());
        for i in 0..kept {
            let j = i + (random.unit() * (sample.len() - i) as f64) as usize;
            sample.swap(i, j);
        }
        sample.truncate(kept);
        let start = Instant::now();
        let statistics = BoxStatistics::of_sample(&mut sample, groups);
        let built = start.elapsed();
        println!(
            "{name}: {} rows, {} bytes, built in {built:.0?}",
            boxes.len(),
            4 * statistics.to_numbers().len()
        );
        let extent = Box3d::around(boxes.iter().flat_map(|b| [b.min, b.max])).unwrap();
        for kind in [
            "&& box",
            "&& column",
            "<@ box",
            "<@ column",
            "@> inside",
            "&& cone",
            "&& sector",
        ] {
            let mut score = Score::default();
            let (mut asked, mut took) = (0, std::time::Duration::ZERO);
            while !full(&score) && asked < 3 * QUERIES {
                let (_, holds, estimate) = query(kind, &mut random, &boxes, &extent);
                let count = boxes.iter().filter(|b| holds(b)).count() as f64;
                let start = Instant::now();
                let share = estimate(&statistics);
                took += start.elapsed();
                asked += 1;
                score.add(share * boxes.len() as f64, count, boxes.len() as f64);
            }
            println!(
                "    {kind:10} {}  {:.1?} each",
                score.print(),
                took / asked.max(1) as u32
            );
        }
        let start = Instant::now();
        let pairs = statistics.share_of_pairs(BoxRelation::Overlaps, &statistics);
        println!("    self join {pairs:.3e} in {:.0?}", start.elapsed());
    }
}
