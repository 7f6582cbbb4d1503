// Moves the camera by mouse, fingers and keys, for the views that share it.
import { RefObject } from "preact";
import { fitted, panned, turned, views, zoomed } from "./camera";
import { followFingers } from "./fingers";
import { set, state } from "./store";

const degreesPerPixel = 0.4;

export function moveByPointer(canvas: RefObject<HTMLCanvasElement>) {
  const mm = () => state.camera!.height / canvas.current!.clientHeight;
  return {
    ...followFingers({
      one(dx, dy, event) {
        if (!state.camera) return;
        const isPan = event.buttons !== 1 || event.shiftKey || event.ctrlKey;
        set({ camera: isPan ? panned(state.camera, dx * mm(), dy * mm()) : turned(state.camera, -dx * degreesPerPixel, dy * degreesPerPixel) });
      },
      two(dx, dy, by) {
        if (state.camera) set({ camera: zoomed(panned(state.camera, dx * mm(), dy * mm()), by) });
      },
    }),
    onContextMenu: (event: Event) => event.preventDefault(),
    onWheel(event: WheelEvent) {
      event.preventDefault();
      // A pinch on a touchpad comes as a wheel with Ctrl, in smaller steps.
      const pace = event.ctrlKey ? 100 : 600;
      if (state.camera) set({ camera: zoomed(state.camera, Math.exp(-event.deltaY / pace)) });
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
