// Keeps tiles of layers, as the printer gets them: they are requested when they are seen, and kept while there is room.
import { Refused, connection } from "./session/connection";
import { about } from "./session/evaluation";
import { Plan, state } from "./store";

export const tileSize = 256; // pixels
const mostPlans = 50,
  mostKept = 600,
  mostAtOnce = 6;

export interface Tile {
  picture?: ImageBitmap;
  problem?: string; // a tile with a problem is not requested again
  x: number; // place of its first pixel, at its level
  y: number;
}

export class Tiles {
  private kept = new Map<string, Tile>();
  private wanted: { key: string; members: Record<string, number>; tile: Tile }[] = [];
  private atWork = new Map<string, () => void>();
  private plans = new Map<string, Plan | "requested">();

  constructor(private changed: () => void) {}

  // Returns the lattice of the job with voxels 2^level times as long along x and y; nothing while it is unknown.
  plan(level: number): Plan | undefined {
    if (!state.plan || !state.design || state.plan.design !== state.design.design) return undefined;
    if (level === 0) return state.plan;
    const key = this.key(level);
    const known = this.plans.get(key);
    if (known === undefined) this.askPlan(key, level);
    return known === "requested" ? undefined : known;
  }

  private async askPlan(key: string, level: number) {
    this.plans.set(key, "requested");
    while (this.plans.size > mostPlans) this.plans.delete(this.plans.keys().next().value!);
    try {
      const design = state.design!.design;
      this.plans.set(key, { ...((await about("plan", { ...state.options, level }, "")) as unknown as Plan), design });
      this.changed();
    } catch {
      this.plans.delete(key);
    }
  }

  private key(level: number) {
    return `${state.design?.design} ${JSON.stringify(state.options)} ${level}`;
  }

  // Returns the tiles of these numbers. Missing ones are requested, and requests for others are cancelled.
  want(level: number, layer: number, places: [number, number][]): Tile[] {
    const tiles: Tile[] = [];
    this.wanted = [];
    const keys = new Set<string>();
    for (const [column, row] of places) {
      const key = `${this.key(level)} ${layer} ${column} ${row}`;
      keys.add(key);
      let tile = this.kept.get(key);
      if (!tile) tile = { x: column * tileSize, y: row * tileSize };
      this.kept.delete(key);
      this.kept.set(key, tile);
      if (!tile.picture && !tile.problem && !this.atWork.has(key))
        this.wanted.push({ key, tile, members: { level, layer, x: tile.x, y: tile.y, width: tileSize, height: tileSize } });
      tiles.push(tile);
    }
    for (const [key, cancel] of this.atWork) if (!keys.has(key)) cancel();
    while (this.kept.size > mostKept) {
      const oldest = this.kept.keys().next().value!;
      this.kept.delete(oldest);
    }
    this.ask();
    return tiles;
  }

  private ask() {
    while (this.wanted.length > 0 && this.atWork.size < mostAtOnce && connection.isOpen) {
      const { key, members, tile } = this.wanted.shift()!;
      const question = connection.ask("tile", { design: state.design!.design, ...state.options, ...members });
      this.atWork.set(key, question.cancel);
      question.answer
        .then((reply) => createImageBitmap(new Blob([reply.bytes as BlobPart], { type: "image/png" })))
        .then((picture) => (tile.picture = picture))
        .catch((error: Refused) => {
          if (!error.isCancelled) tile.problem = error.message;
        })
        .finally(() => {
          this.atWork.delete(key);
          this.changed();
          this.ask();
        });
    }
  }
}
