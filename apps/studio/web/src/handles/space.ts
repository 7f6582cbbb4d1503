// Points, directions and affine maps, for handles.

export type Vec = [number, number, number];
// The rows of an affine map; the last column is a translation.
export type Rows = number[][];

export const identity: Rows = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]];

export const plus = (a: Vec, b: Vec, factor = 1): Vec => [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]];
export const minus = (a: Vec, b: Vec): Vec => plus(a, b, -1);
export const times = (factor: number, a: Vec): Vec => [factor * a[0], factor * a[1], factor * a[2]];
export const dot = (a: Vec, b: Vec) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vec, b: Vec): Vec => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const lengthOf = (a: Vec) => Math.hypot(...a);
export const unit = (a: Vec): Vec => times(1 / (lengthOf(a) || 1), a);

export const mapDirection = (rows: Rows, v: Vec): Vec => [0, 1, 2].map((n) => rows[n][0] * v[0] + rows[n][1] * v[1] + rows[n][2] * v[2]) as Vec;
export const mapPoint = (rows: Rows, p: Vec): Vec => plus(mapDirection(rows, p), [rows[0][3], rows[1][3], rows[2][3]]);

// Returns the inverse map, or undefined if the map flattens space.
export function inverseOf(rows: Rows): Rows | undefined {
  const [a, b, c] = rows.map((row) => row.slice(0, 3) as Vec);
  const columns = [cross(b, c), cross(c, a), cross(a, b)];
  const determinant = dot(a, columns[0]);
  if (!(Math.abs(determinant) > 0)) return undefined;
  const linear = [0, 1, 2].map((n) => columns.map((column) => column[n] / determinant));
  const moved = mapDirection(linear, [rows[0][3], rows[1][3], rows[2][3]]);
  return linear.map((row, n) => [...row, -moved[n]]);
}

// Turns a vector about an axis, right-handed.
export function turnedAbout(v: Vec, axis: Vec, degrees: number): Vec {
  const k = unit(axis), angle = (degrees * Math.PI) / 180;
  return plus(plus(times(Math.cos(angle), v), cross(k, v), Math.sin(angle)), k, dot(k, v) * (1 - Math.cos(angle)));
}

// Returns a direction of length 1 across `axis`, towards `toward` as far as that is possible.
export function acrossTo(axis: Vec, toward: Vec): Vec {
  const z = unit(axis), x = plus(toward, z, -dot(toward, z));
  if (lengthOf(x) > 1e-9 * lengthOf(toward)) return unit(x);
  return unit(Math.abs(z[0]) < 0.9 ? plus([1, 0, 0], z, -z[0]) : plus([0, 1, 0], z, -z[1]));
}

// A line of sight: all points from + s along.
export interface Ray {
  from: Vec;
  along: Vec;
}

export const mapRay = (rows: Rows, ray: Ray): Ray => ({ from: mapPoint(rows, ray.from), along: mapDirection(rows, ray.along) });

// Returns the point in which the ray meets a plane, or undefined if it runs along the plane.
export function onPlane(ray: Ray, point: Vec, normal: Vec): Vec | undefined {
  const rate = dot(unit(ray.along), unit(normal));
  if (Math.abs(rate) < 0.02) return undefined;
  return plus(ray.from, ray.along, dot(minus(point, ray.from), normal) / dot(ray.along, normal));
}

// Returns how far along a line through `point` it comes nearest to the ray, or undefined if they are parallel. The
// length of `direction` is 1.
export function alongLine(ray: Ray, point: Vec, direction: Vec): number | undefined {
  const sight = unit(ray.along), w = minus(point, ray.from);
  const b = dot(direction, sight), sine = 1 - b * b;
  return sine < 1e-4 ? undefined : (b * dot(sight, w) - dot(direction, w)) / sine;
}

// Returns the direction from `centre` to where the ray meets a ball, on the side of `before`; beside the ball, to the
// nearest place on it.
export function onBall(ray: Ray, centre: Vec, radius: number, before: Vec): Vec {
  const sight = unit(ray.along), w = minus(ray.from, centre);
  const nearest = plus(w, sight, -dot(w, sight));
  const inside = radius * radius - dot(nearest, nearest);
  if (inside <= 0) return unit(nearest);
  return unit(plus(nearest, sight, (dot(before, sight) < 0 ? -1 : 1) * Math.sqrt(inside)));
}
