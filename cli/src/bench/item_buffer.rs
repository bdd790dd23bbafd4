//! [`ItemBuffer`], what rays of Embree meet around an eye.

use embree::{Device, Geometry, IntersectContext, Ray, RayHit, Scene, TriangleMesh};
use oracle::{Point, Triangle};
use renderer::{Face, pixel_direction};

/// Side of a square of pixels whose rays are cast together: neighbours take the same way through
/// the tree. Larger squares have less in common, smaller ones are more calls.
const TILE: u32 = 16;

/// Share of the way to a target that counts as arrived: single precision errs far less, and what
/// arrives is decided exactly.
const ARRIVED: f32 = 1.0 - 1e-4;

/// Triangles in a tree of Embree. It computes in single precision, so they are placed relative to
/// a point near the eyes, where numbers are finest. Everything is on the calling thread, but for the building.
pub struct ItemBuffer<'a> {
    scene: Scene<'a>,
    origin: Point,
    /// From where it looks, metres.
    pub eye: Point,
    /// The feature that each triangle belongs to.
    owners: Vec<u32>,
}

/// For each number the direction of a pixel that shows it.
pub struct Sightings(Vec<Option<Point>>);

impl<'a> ItemBuffer<'a> {
    /// Builds the tree for an eye, and others near it.
    pub fn new(device: &'a Device, eye: Point, triangles: &[(u32, Triangle)]) -> Self {
        let mut scene = Scene::new(device);
        if !triangles.is_empty() {
            scene.attach_geometry(geometry(device, eye, triangles));
        }
        scene.commit();
        Self {
            scene,
            origin: eye,
            eye,
            owners: triangles.iter().map(|(owner, _)| *owner).collect(),
        }
    }

    /// Looks through the middles of all pixels of six faces. The resolution is a multiple of 16.
    pub fn look(&self, resolution: u32) -> Sightings {
        let most = self.owners.iter().max().map_or(0, |&most| most as usize);
        let mut seen = vec![None; most + 1];
        let mut rays = Vec::new();
        let corners = || (0..resolution).step_by(TILE as usize);
        let tiles = corners().flat_map(|y| corners().map(move |x| (x, y)));
        for (face, (left, top)) in Face::ALL
            .into_iter()
            .flat_map(|face| tiles.clone().map(move |corner| (face, corner)))
        {
            let direction = |pixel: u32| {
                let (x, y) = (left + pixel % TILE, top + pixel / TILE);
                pixel_direction(face, x, y, resolution)
            };
            self.cast(&mut rays, (0..TILE * TILE).map(direction));
            for (hit, pixel) in rays.iter().zip(0..) {
                if let Some(owner) = self.owner(hit) {
                    seen[owner as usize].get_or_insert_with(|| direction(pixel));
                }
            }
        }
        Sightings(seen)
    }

    /// Those of the targets, which lie on a feature, that nothing else seems to hide.
    pub fn aim(&self, owner: u32, targets: &[Point]) -> Vec<Point> {
        let mut rays = Vec::new();
        let towards = |target: &Point| std::array::from_fn(|axis| target[axis] - self.eye[axis]);
        self.cast(&mut rays, targets.iter().map(towards));
        let arrives = |hit: &RayHit| {
            hit.ray.tfar >= ARRIVED || self.owner(hit).is_none_or(|first| first == owner)
        };
        targets
            .iter()
            .zip(&rays)
            .filter(|(_, hit)| arrives(hit))
            .map(|(target, _)| *target)
            .collect()
    }

    /// Casts rays from the eye, as one stream.
    fn cast(&self, rays: &mut Vec<RayHit>, directions: impl Iterator<Item = Point>) {
        let origin: [f32; 3] =
            std::array::from_fn(|axis| (self.eye[axis] - self.origin[axis]) as f32);
        rays.clear();
        rays.extend(directions.map(|direction| {
            let direction = direction.map(|component| component as f32);
            RayHit::new(Ray::new(origin.into(), direction.into()))
        }));
        // Nothing has changed since the tree was built, so that this only hands it out.
        let tree = self.scene.commit();
        tree.intersect_stream_aos(&mut IntersectContext::coherent(), rays);
    }

    fn owner(&self, hit: &RayHit) -> Option<u32> {
        hit.hit.hit().then(|| self.owners[hit.hit.primID as usize])
    }
}

impl Sightings {
    /// All numbers that were seen.
    pub fn numbers(&self) -> impl Iterator<Item = u32> {
        let seen = self.0.iter().zip(0..);
        seen.filter_map(|(direction, number)| direction.is_some().then_some(number))
    }

    /// Where a number was seen.
    pub fn of(&self, number: u32) -> Option<Point> {
        self.0.get(number as usize).copied().flatten()
    }
}

fn geometry<'a>(device: &'a Device, eye: Point, triangles: &[(u32, Triangle)]) -> Geometry<'a> {
    let mut mesh = TriangleMesh::unanimated(device, triangles.len(), 3 * triangles.len());
    let mut vertices = mesh.vertex_buffer.map();
    let mut corners = mesh.index_buffer.map();
    for (position, (_, triangle)) in triangles.iter().enumerate() {
        for (corner, vertex) in triangle.iter().enumerate() {
            let at = |axis: usize| (vertex[axis] - eye[axis]) as f32;
            vertices[3 * position + corner] = [at(0), at(1), at(2), 0.0].into();
        }
        let first = u32::try_from(3 * position).unwrap_or(u32::MAX - 2);
        corners[position] = [first, first + 1, first + 2].into();
    }
    drop((vertices, corners));
    let mut geometry = Geometry::Triangle(mesh);
    geometry.commit();
    geometry
}

#[cfg(test)]
mod tests {
    use super::*;

    const EYE: Point = [85_000.0, 447_000.0, 1.7];

    /// A wall across the x axis, from -1 to 1 m in y at most, 2 m high.
    fn wall(x: f64, half: f64) -> [Triangle; 2] {
        let at = |y: f64, z: f64| [EYE[0] + x, EYE[1] + y, EYE[2] + z];
        let [a, b, c, d] = [
            at(-half, -1.0),
            at(half, -1.0),
            at(half, 1.0),
            at(-half, 1.0),
        ];
        [[a, b, c], [a, c, d]]
    }

    /// A wall, one behind it that is hidden, and one as far that stands out.
    fn scene() -> Vec<(u32, Triangle)> {
        let walls = [
            (1, wall(10.0, 1.0)),
            (2, wall(20.0, 0.5)),
            (3, wall(20.0, 3.0)),
        ];
        let each = walls.into_iter();
        each.flat_map(|(number, wall)| wall.map(|triangle| (number, triangle)))
            .collect()
    }

    #[test]
    fn what_is_behind_another_is_not_seen() {
        let device = Device::new();
        let buffer = ItemBuffer::new(&device, EYE, &scene());
        let sightings = buffer.look(128);
        assert_eq!(sightings.numbers().collect::<Vec<_>>(), [1, 3]);
        let [x, y, _] = sightings.of(3).unwrap();
        assert!(x == 1.0 && 0.1 < y.abs() && y.abs() < 0.15);
        assert_eq!((sightings.of(2), sightings.of(9)), (None, None));
    }

    #[test]
    fn pixels_miss_what_is_narrow() {
        let device = Device::new();
        let post = wall(90.0, 0.01).map(|triangle| (1, triangle));
        let buffer = ItemBuffer::new(&device, EYE, &post);
        assert_eq!(buffer.look(16).numbers().count(), 0);
        let target = [EYE[0] + 90.0, EYE[1] + 0.005, EYE[2] + 0.3];
        assert_eq!(buffer.aim(1, &[target]), [target]);
    }

    #[test]
    fn targets_are_hidden_by_others_only() {
        let device = Device::new();
        let buffer = ItemBuffer::new(&device, EYE, &scene());
        let at = |x: f64, y: f64| [EYE[0] + x, EYE[1] + y, EYE[2]];
        let targets = [at(20.0, 0.2), at(20.0, 2.5)];
        assert_eq!(buffer.aim(3, &targets), [at(20.0, 2.5)]);
        // The wall in front is the feature itself.
        assert_eq!(buffer.aim(1, &targets), targets);
    }

    #[test]
    fn one_tree_serves_eyes_beside_and_behind() {
        let device = Device::new();
        let mut buffer = ItemBuffer::new(&device, EYE, &scene()[..4]);
        let mut seen_from = |x: f64, y: f64| -> Vec<u32> {
            buffer.eye = [EYE[0] + x, EYE[1] + y, EYE[2]];
            buffer.look(128).numbers().collect()
        };
        assert_eq!(seen_from(0.0, 0.0), [1]);
        assert_eq!(seen_from(0.0, 6.0), [1, 2]);
        assert_eq!(seen_from(22.0, 0.0), [2]);
    }

    #[test]
    fn nothing_is_seen_where_nothing_is() {
        let device = Device::new();
        let buffer = ItemBuffer::new(&device, EYE, &[]);
        assert_eq!(buffer.look(16).numbers().count(), 0);
    }
}
