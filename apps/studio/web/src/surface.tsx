// Shows the design from outside, drawn by the server: small first, then as fine as the screen.
import { ComponentChildren } from "preact";
import { useLayoutEffect, useMemo, useRef, useState } from "preact/hooks";
import { barLength, fieldOfView, fitted, length, views } from "./camera";
import { CutControls, cutMembers } from "./cuts";
import { Handles } from "./handles/handles";
import { LateField } from "./latefield";
import { moveByKeys, moveByPointer, placeCamera } from "./navigation";
import { Refused, connection } from "./session/connection";
import { about } from "./session/evaluation";
import { Camera, set, state, useStore } from "./store";

const steps = [
  { share: 0.1, samples: 1 }, // only for slow designs
  { share: 0.3, samples: 1 },
  { share: 1, samples: 1 },
  { share: 1, samples: 2 },
];

const longMilliseconds = 120; // limit for the second step

// Returns a key; pictures of equal keys differ only in size.
function pictureKey(): string {
  const { design, camera, cut, perspective, by, palette, range, opacity } = state;
  return JSON.stringify([design?.design, camera, cut, perspective, by, palette, range, opacity, voxelMembers()]);
}

// Returns the key of a range of values.
const coloursKey = () => `${state.design?.design} ${state.by}`;

// Returns the range that is set, or the one that the server found for the same colours before.
function colourMembers(): Record<string, unknown> {
  const { by, palette, range, shownRange } = state;
  if (!by) return {};
  const known = range ?? (shownRange?.of === coloursKey() ? shownRange.range : undefined);
  return { by, palette, ...(known ? { range: known } : {}) };
}

// Returns the job whose voxels the faces of the cut show, if they do.
const voxelMembers = (): Record<string, unknown> => (state.cut && state.showsVoxels && !state.by ? { voxels: state.options } : {});

function noteRange(of: string, range: [number, number] | undefined) {
  if (range && !state.range && (state.shownRange?.of !== of || state.shownRange.range.join() !== range.join())) set({ shownRange: { of, range } });
}

// Returns the members of a request for a picture from this camera, except for its size.
export function renderMembers(camera: Camera): Record<string, unknown> {
  return {
    azimuth: camera.azimuth,
    elevation: camera.elevation,
    target: camera.target,
    height_mm: camera.height,
    perspective: fieldOfView(),
    ...cutMembers(state.cut),
    ...colourMembers(),
    ...voxelMembers(),
    opacity: state.opacity,
  };
}

// The canvas gets the proportions of the picture, so that one for an earlier size of the view is never stretched.
async function drawOne(canvas: HTMLCanvasElement, step: (typeof steps)[0]) {
  const { camera, file } = state;
  if (!camera) return;
  const colours = coloursKey();
  const [fullWidth, fullHeight] = [canvas.clientWidth, canvas.clientHeight].map((side) => Math.max(1, Math.round(side * Math.min(devicePixelRatio, 2))));
  const [width, height] = [fullWidth, fullHeight].map((side) => Math.max(1, Math.round(side * step.share)));
  const started = performance.now();
  const reply = await about("render", { width, height, samples: step.samples, ...renderMembers(camera) }, "surface");
  noteRange(colours, reply.range);
  const picture = await createImageBitmap(new Blob([reply.bytes as BlobPart], { type: "image/png" }));
  if (state.file !== file) return picture.close(); // another file was opened meanwhile
  canvas.width = fullWidth;
  canvas.height = fullHeight;
  const context = canvas.getContext("2d")!;
  context.imageSmoothingEnabled = true;
  context.drawImage(picture, 0, 0, canvas.width, canvas.height);
  picture.close();
  canvas.dataset.milliseconds = String(Math.round(performance.now() - started));
}

// Draws one picture after the other, each finer, until something changes. A small picture is finished before the next
// is begun, so that something is seen while the camera moves; a finer one is cancelled at once.
class Drawer {
  private first = 0;
  private step = 0;
  private key = "";
  private isAtWork = false;
  constructor(private canvas: HTMLCanvasElement) {}

  async go() {
    if (this.isAtWork && (this.step === this.first || pictureKey() === this.key)) return;
    if (this.isAtWork) {
      this.step = this.first;
      this.key = "";
      return connection.cancelLane("surface");
    }
    this.isAtWork = true;
    while (this.isLeft()) await this.drawStep();
    this.isAtWork = false;
  }
  again() {
    this.key = "";
    this.go();
  }

  // Removes the picture of another file.
  clear() {
    if (state.design) return;
    this.canvas.getContext("2d")!.clearRect(0, 0, this.canvas.width, this.canvas.height);
    delete this.canvas.dataset.state;
    delete this.canvas.dataset.design;
    this.tell("");
  }

  private isLeft(): boolean {
    if (!state.design || !state.camera || this.canvas.clientWidth === 0 || !connection.isOpen) return false;
    if (pictureKey() !== this.key) this.step = this.first;
    this.key = pictureKey();
    return this.step < steps.length;
  }

  private async drawStep() {
    const key = this.key,
      design = state.design!.design;
    this.canvas.dataset.state = "drawing";
    try {
      const begun = performance.now();
      await drawOne(this.canvas, steps[this.step]);
      if (!state.design) return;
      if (this.step === 1) this.first = performance.now() - begun > longMilliseconds ? 0 : 1;
      this.canvas.dataset.design = design;
      this.tell("");
      if (this.key !== key) return;
      ++this.step;
      if (this.step === steps.length) this.canvas.dataset.state = "ready";
    } catch (error) {
      if ((error as Refused).isCancelled) return;
      this.step = steps.length;
      this.canvas.dataset.state = "failed";
      this.tell((error as Error).message);
    }
  }

  private tell(problem: string) {
    this.canvas.parentElement!.querySelector(".viewproblem")!.textContent = problem;
  }
}

export function ScaleBar({ pixelMm }: { pixelMm: number }) {
  if (!isFinite(pixelMm) || pixelMm <= 0) return null;
  const mm = barLength(pixelMm * 140);
  return (
    <div class="scalebar" style={{ width: `${mm / pixelMm}px` }}>
      {length(mm)}
    </div>
  );
}

export function Legend() {
  const { design } = useStore();
  return (
    <ul class="legend" aria-label="Materials">
      {design?.materials.map((m) => (
        <li>
          <span class="swatch" style={{ background: `rgb(${m.colour.slice(0, 3).join(",")})` }} />
          {m.name}
        </li>
      ))}
    </ul>
  );
}

const shortNumber = (value: number) => String(+value.toPrecision(4));

// Shows the values that colours stand for, with fields to set them.
function ColourLegend() {
  const { by, palette, range, shownRange, design, hello } = useStore();
  const known = range ?? (shownRange?.of === coloursKey() ? shownRange.range : undefined);
  if (!by || !known) return null;
  const colours = (hello?.palettes.find((p) => p.name === palette) ?? hello?.palettes[0])?.colours ?? [];
  const unit = design?.attributes.find((a) => a.name === by)?.unit;
  const change = (end: number, text: string) => {
    const made = known.map((v, n) => (n === end ? +text : v)) as [number, number];
    if (text !== "" && made[0] < made[1]) set({ range: made });
  };
  return (
    <div class="colours" role="group" aria-label="Colours" data-range={known.join()}>
      <span>{by}{unit && unit !== "1" ? `, ${unit}` : ""}</span>
      <span class="ramp" style={{ background: `linear-gradient(in srgb-linear to right, ${colours.map((c) => `rgb(${c.join(",")})`).join(",")})` }} />
      <span class="controls">
        <LateField type="number" step="any" aria-label="Value of the first colour" value={shortNumber(known[0])} take={(text) => change(0, text)} />
        <button disabled={!range} onClick={() => set({ range: undefined })}>all</button>
        <LateField type="number" step="any" aria-label="Value of the last colour" value={shortNumber(known[1])} take={(text) => change(1, text)} />
      </span>
    </div>
  );
}

function ViewButtons() {
  const { design, perspective } = useStore();
  const look = (from: { azimuth: number; elevation: number }, fit: boolean) => {
    if (!design) return;
    const view = document.querySelector<HTMLElement>(".surface canvas, .volume canvas");
    const aspect = view && view.clientHeight ? view.clientWidth / view.clientHeight : 1.4;
    set({ camera: fit || !state.camera ? fitted(design, aspect, from) : { ...state.camera, ...from } });
  };
  return (
    <span class="controls">
      <label>
        From
        <select value="" onChange={(e) => { look(views[e.currentTarget.value], false); e.currentTarget.value = ""; }}>
          <option value="">…</option>
          {Object.keys(views).map((name) => <option value={name}>{name}</option>)}
        </select>
      </label>
      <button onClick={() => look(state.camera ?? views.iso, true)}>fit</button>
      <label>
        <input type="checkbox" checked={perspective} onChange={(e) => set({ perspective: e.currentTarget.checked })} />
        Perspective
      </label>
    </span>
  );
}

// Shows how the part is seen and by what it is coloured: `others` are options beside its materials.
export function ViewBar({ others, children }: { others: ComponentChildren; children: ComponentChildren }) {
  const { by, handles } = useStore();
  return (
    <div class="viewbar">
      <ViewButtons />
      <CutControls />
      <label>
        Colour by
        <select value={by} onChange={(e) => set({ by: e.currentTarget.value, range: undefined })}>
          <option value="">materials</option>
          {others}
        </select>
      </label>
      {children}
      <label title="Where the caret stands in a call whose numbers are places, they can be moved in the view">
        <input type="checkbox" checked={handles} onChange={(e) => set({ handles: e.currentTarget.checked })} />
        Handles
      </label>
    </div>
  );
}

// Returns a choice for each name of an attribute.
export const attributeOptions = (attributes: { name: string }[] = []) => attributes.map((a) => <option value={a.name}>{a.name}</option>);

export function SurfaceView() {
  const { design, camera, cut, by, palette, hello, file, showsVoxels } = useStore();
  const canvas = useRef<HTMLCanvasElement>(null);
  const drawer = useRef<Drawer>();
  const [height, setHeight] = useState(1);
  const pointer = useMemo(() => moveByPointer(canvas), []);
  useLayoutEffect(() => {
    drawer.current = new Drawer(canvas.current!);
    const size = new ResizeObserver(() => {
      setHeight(canvas.current!.clientHeight);
      drawer.current!.again();
    });
    size.observe(canvas.current!);
    return () => size.disconnect();
  }, []);
  useLayoutEffect(() => drawer.current?.clear(), [file, design === undefined]);
  useLayoutEffect(() => placeCamera(canvas.current!), [design]);
  const key = pictureKey();
  useLayoutEffect(() => void drawer.current?.go(), [key]); // before anything else sees the state of an older picture
  return (
    <section class="view surface" aria-label="Surface">
      <ViewBar others={[...(design?.materials ?? []).map((m) => <option value={m.name}>fraction of {m.name}</option>), ...attributeOptions(design?.attributes)]}>
        {by && (
          <label>
            Palette
            <select value={palette} onChange={(e) => set({ palette: e.currentTarget.value })}>
              {hello?.palettes.map((p, n) => <option value={n === 0 ? "" : p.name}>{p.name}</option>)}
            </select>
          </label>
        )}
        {cut && !by && (
          <label title="The faces of the cut show the voxels that the printer gets">
            <input type="checkbox" checked={showsVoxels} onChange={(e) => set({ showsVoxels: e.currentTarget.checked })} />
            Voxels
          </label>
        )}
      </ViewBar>
      <div class="stage">
        <canvas ref={canvas} tabIndex={0} role="img" aria-label={`The design from outside${design ? `, materials ${design.materials.map((m) => m.name).join(", ")}` : ""}. Arrows turn it, with Shift they move it, plus and minus zoom.`}
                {...pointer} onKeyDown={moveByKeys} />
        <Handles canvas={canvas} members={renderMembers} />
        <p class="viewproblem" role="status"></p>
        {by ? <ColourLegend /> : <Legend />}
        {camera && <ScaleBar pixelMm={camera.height / height} />}
      </div>
    </section>
  );
}
