// The camera. Angles are degrees: azimuth 0 is in front (at -y), 90 at +x.
import { Camera, Design, state } from "./store";

const radians = Math.PI / 180;

export function axes(camera: Camera) {
  const a = camera.azimuth * radians,
    e = camera.elevation * radians;
  return {
    right: [Math.cos(a), Math.sin(a), 0],
    down: [Math.sin(a) * Math.sin(e), -Math.cos(a) * Math.sin(e), -Math.cos(e)],
    forward: [-Math.sin(a) * Math.cos(e), Math.cos(a) * Math.cos(e), -Math.sin(e)],
  };
}

const dot = (a: number[], b: number[]) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

// Returns a camera that sees the whole design.
export function fitted(design: Design, aspect: number, from: { azimuth: number; elevation: number }): Camera {
  const [lo, hi] = design.bounds_mm;
  const camera: Camera = { ...from, target: lo.map((v, n) => (v + hi[n]) / 2), height: 1 };
  const { right, down } = axes(camera);
  let height = 0;
  for (let corner = 0; corner < 8; ++corner) {
    const p = lo.map((v, n) => ((corner >> n) & 1 ? hi[n] : v) - camera.target[n]);
    height = Math.max(height, 2 * Math.abs(dot(p, down)), (2 * Math.abs(dot(p, right))) / aspect);
  }
  return { ...camera, height: 1.1 * (height || 1) };
}

// Vertical field of view in degrees; 0: rays are parallel.
export const fieldOfView = () => (state.perspective ? 35 : 0);

// Returns the distance of the eye from the target, mm; 0 stands for parallel rays.
export function eyeDistance(camera: Camera): number {
  return state.perspective ? camera.height / 2 / Math.tan((fieldOfView() / 2) * radians) : 0;
}

export function panned(camera: Camera, dx: number, dy: number): Camera {
  const { right, down } = axes(camera);
  return { ...camera, target: camera.target.map((v, n) => v - dx * right[n] - dy * down[n]) };
}

export function turned(camera: Camera, azimuth: number, elevation: number): Camera {
  return {
    ...camera,
    azimuth: (((camera.azimuth + azimuth + 180) % 360) + 360) % 360 - 180,
    elevation: Math.max(-90, Math.min(90, camera.elevation + elevation)),
  };
}

export function zoomed(camera: Camera, by: number): Camera {
  return { ...camera, height: camera.height / by };
}

export const views: Record<string, { azimuth: number; elevation: number }> = {
  iso: { azimuth: -35, elevation: 25 },
  front: { azimuth: 0, elevation: 0 },
  right: { azimuth: 90, elevation: 0 },
  back: { azimuth: 180, elevation: 0 },
  left: { azimuth: -90, elevation: 0 },
  top: { azimuth: 0, elevation: 90 },
  bottom: { azimuth: 0, elevation: -90 },
};

// Returns the length of a scale bar, at most `most`: 1, 2 or 5 times a power of ten.
export function barLength(most: number): number {
  const power = 10 ** Math.floor(Math.log10(most));
  return (most / power >= 5 ? 5 : most / power >= 2 ? 2 : 1) * power;
}

export function length(mm: number): string {
  if (mm < 0.1) return `${+(mm * 1000).toPrecision(3)} µm`;
  return `${+mm.toPrecision(4)} mm`;
}

// Returns where a point of the design is seen in a picture of this size, in pixels, and how many pixels a mm has there.
// Points behind the eye are seen nowhere.
export function projected(camera: Camera, size: { width: number; height: number }, p: number[]): { x: number; y: number; pixels: number } | undefined {
  const { right, down, forward } = axes(camera);
  const v = p.map((c, n) => c - camera.target[n]);
  const distance = eyeDistance(camera);
  const stretch = distance === 0 ? 1 : (distance + dot(v, forward)) / distance;
  if (stretch <= 0.01) return undefined;
  const pixels = size.height / camera.height / stretch;
  return { x: size.width / 2 + pixels * dot(v, right), y: size.height / 2 + pixels * dot(v, down), pixels };
}

// Returns the line of sight through a pixel of such a picture.
export function sightThrough(camera: Camera, size: { width: number; height: number }, x: number, y: number): { from: [number, number, number]; along: [number, number, number] } {
  const { right, down, forward } = axes(camera);
  const mm = camera.height / size.height, r = (x - size.width / 2) * mm, d = (y - size.height / 2) * mm;
  const at = camera.target.map((c, n) => c + r * right[n] + d * down[n]) as [number, number, number];
  const distance = eyeDistance(camera);
  if (distance === 0) return { from: at, along: forward as [number, number, number] };
  const eye = camera.target.map((c, n) => c - distance * forward[n]) as [number, number, number];
  return { from: eye, along: at.map((c, n) => c - eye[n]) as [number, number, number] };
}
