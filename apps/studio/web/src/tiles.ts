// Keeps tiles of layers, as the printer gets them: they are requested when they are seen, and kept while there is room.
import { Refused, connection } from "./session/connection";
import { about } from "./session/evaluation";
import { Plan, state } from "./store";

export const tileSize = 256; // pixels
const mostPlans = 50,
  mostKept = 600,
  mostAtOnce = 6;

export interface Tile {
  key: string;
  level: number;
  layer: number;
  x: number; // place of its first pixel, at its level
  y: number;
  picture?: ImageBitmap;
  problem?: string; // a tile with a problem is not requested again
}

export class Tiles {
  private kept = new Map<string, Tile>();
  private wanted: Tile[] = [];
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

  // Returns the tiles of these numbers, with what is known of them.
  find(level: number, layer: number, places: [number, number][]): Tile[] {
    return places.map(([column, row]) => {
      const key = `${this.key(level)} ${layer} ${column} ${row}`;
      const tile = this.kept.get(key) ?? { key, level, layer, x: column * tileSize, y: row * tileSize };
      this.kept.delete(key);
      this.kept.set(key, tile);
      return tile;
    });
  }

  // Requests the missing ones of these tiles in their order, and cancels requests for others.
  want(tiles: Tile[]) {
    this.wanted = tiles.filter((tile) => !tile.picture && !tile.problem && !this.atWork.has(tile.key));
    const keys = new Set(tiles.map((tile) => tile.key));
    for (const [key, cancel] of this.atWork) if (!keys.has(key)) cancel();
    while (this.kept.size > mostKept) {
      const oldest = this.kept.keys().next().value!;
      this.kept.delete(oldest);
    }
    this.ask();
  }

  private ask() {
    while (this.wanted.length > 0 && this.atWork.size < mostAtOnce && connection.isOpen) {
      const tile = this.wanted.shift()!;
      const { key, level, layer, x, y } = tile;
      const place = { level, layer, x, y, width: tileSize, height: tileSize };
      const question = connection.ask("tile", { design: state.design!.design, ...state.options, ...place });
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
