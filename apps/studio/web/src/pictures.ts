// Makes pictures of the views, and turntables, in the browser, for the person's own disk.
import { GIFEncoder, applyPalette, quantize } from "gifenc";
import { download, stem } from "./files";
import { about } from "./session/evaluation";
import { Camera, set, state } from "./store";
import { renderMembers } from "./surface";

function pngOf(canvas: HTMLCanvasElement): Promise<Blob> {
  return new Promise((resolve, reject) => canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("the browser makes no picture"))), "image/png"));
}

const paper = () => getComputedStyle(document.querySelector(".view")!).backgroundColor;

// Draws the visible views side by side, without their controls.
export async function takePicture() {
  const grid = document.querySelector<HTMLElement>(".views .grid")!;
  const sources = [...grid.querySelectorAll("canvas")].filter((canvas) => canvas.width > 0 && canvas.clientWidth > 0);
  if (sources.length === 0) return set({ notice: "This view is no picture; choose another one." });
  const places = sources.map((canvas) => canvas.getBoundingClientRect());
  const left = Math.min(...places.map((p) => p.left)), top = Math.min(...places.map((p) => p.top));
  const right = Math.max(...places.map((p) => p.right)), bottom = Math.max(...places.map((p) => p.bottom));
  const ratio = Math.max(...sources.map((canvas) => canvas.width / canvas.clientWidth));
  const made = document.createElement("canvas");
  made.width = Math.round((right - left) * ratio);
  made.height = Math.round((bottom - top) * ratio);
  const context = made.getContext("2d")!;
  context.fillStyle = paper();
  context.fillRect(0, 0, made.width, made.height);
  sources.forEach((canvas, n) => {
    const p = places[n];
    context.drawImage(canvas, (p.left - left) * ratio, (p.top - top) * ratio, p.width * ratio, p.height * ratio);
  });
  download(`${stem()}_${state.view}.png`, await pngOf(made));
}

const frames = 60, framesPerSecond = 20, widest = 720;

async function frameAt(camera: Camera, share: number, size: { width: number; height: number }): Promise<ImageBitmap> {
  const turned = { ...camera, azimuth: camera.azimuth + 360 * share };
  const reply = await about("render", { ...size, samples: 2, ...renderMembers(turned) }, "");
  return createImageBitmap(new Blob([reply.bytes as BlobPart], { type: "image/png" }));
}

// Plays the frames at their pace, since a recorder takes the time from the clock.
async function record(pictures: ImageBitmap[], size: { width: number; height: number }): Promise<Blob> {
  const canvas = document.createElement("canvas");
  Object.assign(canvas, size);
  const context = canvas.getContext("2d")!;
  const recorder = new MediaRecorder(canvas.captureStream(framesPerSecond), { mimeType: "video/webm", videoBitsPerSecond: 8e6 });
  const parts: Blob[] = [];
  recorder.ondataavailable = (event) => parts.push(event.data);
  const ended = new Promise((resolve) => (recorder.onstop = resolve));
  context.fillStyle = paper();
  recorder.start();
  for (const picture of pictures) {
    context.fillRect(0, 0, size.width, size.height);
    context.drawImage(picture, 0, 0);
    await new Promise((resolve) => setTimeout(resolve, 1000 / framesPerSecond));
  }
  recorder.stop();
  await ended;
  return new Blob(parts, { type: "video/webm" });
}

// Makes a GIF in which each frame has the 256 colours that suit it best.
async function animate(pictures: ImageBitmap[], size: { width: number; height: number }): Promise<Blob> {
  const context = new OffscreenCanvas(size.width, size.height).getContext("2d", { willReadFrequently: true })!;
  context.fillStyle = paper();
  const gif = GIFEncoder();
  for (const picture of pictures) {
    context.fillRect(0, 0, size.width, size.height);
    context.drawImage(picture, 0, 0);
    const { data } = context.getImageData(0, 0, size.width, size.height);
    const palette = quantize(data, 256);
    gif.writeFrame(applyPalette(data, palette), size.width, size.height, { palette, delay: 1000 / framesPerSecond });
    await new Promise((resolve) => setTimeout(resolve)); // lets the page react
  }
  gif.finish();
  return new Blob([gif.bytes() as BlobPart], { type: "image/gif" });
}

const makers = { webm: record, gif: animate };

// Turns the design as the surface view shows it once around z, and writes a video or a GIF. A second call ends the one
// that is under way.
export async function makeTurntable(kind: keyof typeof makers) {
  if (state.turntable !== undefined) return set({ turntable: undefined });
  const { design, camera } = state;
  if (!design || !camera) return;
  const view = document.querySelector<HTMLElement>(".surface .stage, .view .stage")!;
  const width = 2 * Math.round(Math.min(widest, view.clientWidth) / 2); // coders of videos need even numbers
  const size = { width, height: 2 * Math.round((width * view.clientHeight) / view.clientWidth / 2) };
  const pictures: ImageBitmap[] = [];
  set({ turntable: 0 });
  try {
    while (pictures.length < frames) {
      pictures.push(await frameAt(camera, pictures.length / frames, size));
      if (state.turntable === undefined) return;
      set({ turntable: pictures.length / frames });
    }
    download(`${stem()}_turntable.${kind}`, await makers[kind](pictures, size));
  } catch (error) {
    set({ notice: (error as Error).message });
  } finally {
    for (const picture of pictures) picture.close();
    set({ turntable: undefined });
  }
}
