// Follows the mouse, a pen or fingers on a canvas: one moves something, two move and zoom it.

export interface Moves {
  begin?: () => void;
  one(dx: number, dy: number, event: PointerEvent): void;
  two(dx: number, dy: number, by: number, at: { x: number; y: number }): void; // `by` is above 1 if they part
}

interface Point {
  x: number;
  y: number;
}

const middle = (a: Point, b: Point): Point => ({ x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 });
const distance = (a: Point, b: Point) => Math.max(1, Math.hypot(a.x - b.x, a.y - b.y));

export function followFingers(moves: Moves) {
  const down = new Map<number, Point>();
  const lift = (event: PointerEvent) => void down.delete(event.pointerId);
  return {
    onPointerDown(event: PointerEvent) {
      if (down.size === 0) moves.begin?.();
      down.set(event.pointerId, { x: event.clientX, y: event.clientY });
      (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
    },
    onPointerMove(event: PointerEvent) {
      const before = down.get(event.pointerId);
      if (!before || event.buttons === 0) return;
      const now = { x: event.clientX, y: event.clientY };
      down.set(event.pointerId, now);
      const other = [...down].find(([id]) => id !== event.pointerId)?.[1];
      if (!other) return moves.one(now.x - before.x, now.y - before.y, event);
      const frame = (event.currentTarget as HTMLElement).getBoundingClientRect();
      const from = middle(before, other), to = middle(now, other);
      moves.two(to.x - from.x, to.y - from.y, distance(now, other) / distance(before, other), { x: to.x - frame.left, y: to.y - frame.top });
    },
    onPointerUp: lift,
    onPointerCancel: lift,
  };
}
