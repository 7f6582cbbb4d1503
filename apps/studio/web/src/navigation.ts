// Moves the camera by mouse, fingers and keys, for the views that share it.
import { RefObject } from "preact";
import { fitted, panned, turned, views, zoomed } from "./camera";
import { set, state } from "./store";

const degreesPerPixel = 0.4;

export function moveByPointer(canvas: RefObject<HTMLCanvasElement>) {
  let last: { x: number; y: number } | undefined;
  return {
    onPointerDown(event: PointerEvent) {
      last = { x: event.clientX, y: event.clientY };
      canvas.current!.setPointerCapture(event.pointerId);
    },
    onPointerMove(event: PointerEvent) {
      if (!last || !state.camera || event.buttons === 0) return;
      const dx = event.clientX - last.x,
        dy = event.clientY - last.y;
      last = { x: event.clientX, y: event.clientY };
      const isPan = event.buttons !== 1 || event.shiftKey || event.ctrlKey;
      const mm = state.camera.height / canvas.current!.clientHeight;
      set({ camera: isPan ? panned(state.camera, dx * mm, dy * mm) : turned(state.camera, -dx * degreesPerPixel, dy * degreesPerPixel) });
    },
    onPointerUp: () => (last = undefined),
    onContextMenu: (event: Event) => event.preventDefault(),
    onWheel(event: WheelEvent) {
      event.preventDefault();
      if (state.camera) set({ camera: zoomed(state.camera, Math.exp(-event.deltaY / 600)) });
    },
  };
}

export function moveByKeys(event: KeyboardEvent) {
  const camera = state.camera;
  if (!camera) return;
  const step = camera.height / 20;
  const arrows: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  const arrow = arrows[event.key];
  if (arrow) set({ camera: event.shiftKey ? panned(camera, arrow[0] * step, arrow[1] * step) : turned(camera, -arrow[0] * 5, arrow[1] * 5) });
  else if (event.key === "+" || event.key === "=") set({ camera: zoomed(camera, 1.2) });
  else if (event.key === "-") set({ camera: zoomed(camera, 1 / 1.2) });
  else if (event.key === "Home" && state.design) set({ camera: fitted(state.design, 1.4, camera) });
  else return;
  event.preventDefault();
}

// Places the camera once, for the view that is seen first; from then on only people move it.
export function placeCamera(canvas: HTMLCanvasElement) {
  const { design, camera } = state;
  if (design && !camera && canvas.clientHeight > 0) set({ camera: fitted(design, canvas.clientWidth / canvas.clientHeight, views.iso) });
}
