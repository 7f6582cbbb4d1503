// Questions about the shown design: amounts, what is at a point, and what has changed since a marked version.
import { Mark, set, state } from "../store";
import { Refused, connection } from "./connection";
import { about, shown } from "./evaluation";

export async function measure() {
  if (!state.design) return;
  const design = state.design.design;
  try {
    set({ measure: { design, ...((await about("measure", {}, "measure")) as any) } });
  } catch {
    // Another request is under way, or the design is gone.
  }
}

export async function probe(at: number[]) {
  const design = state.design?.design;
  try {
    const probe = (await about("probe", { at, ...state.options }, "probe")) as any;
    if (design !== state.design?.design) return; // another design is shown now
    set({ probe, probeBefore: state.probe?.at });
  } catch {
    // The next probe reports more.
  }
}

export function markVersion() {
  if (!state.design) return;
  set({ mark: { design: state.design.design, ...shown, time: new Date().toLocaleTimeString() }, comparison: undefined, comparisonProblem: "" });
}

export function forgetMark() {
  set({ mark: undefined, comparison: undefined, comparisonProblem: "" });
}

// Loads the marked design again, since the server keeps only few designs.
async function remake(mark: Mark): Promise<Mark> {
  if (mark.file.endsWith(".py")) throw new Error("the server has forgotten the marked version: mark another one");
  const { file, text, definitions, rotate } = mark;
  const reply = await connection.ask("load", { file, text, definitions, rotate }, "mark").answer;
  if (!reply.ok) throw new Error("the marked version can no longer be made; files that it reads have changed");
  const made = { ...mark, design: reply.design as string };
  if (state.mark === mark) set({ mark: made });
  return made;
}

async function compareWith(mark: Mark, design: string) {
  const reply = (await connection.ask("compare", { before: mark.design, design }, "compare").answer) as any;
  if (state.mark === mark) set({ comparison: { design, mark, ...reply } });
}

export async function compare() {
  const { mark, design } = state;
  if (!mark || !design) return;
  set({ comparisonProblem: "" });
  try {
    await compareWith(mark, design.design).catch(async (error) => {
      if ((error as Refused).code !== "gone") throw error;
      await compareWith(await remake(mark), design.design);
    });
  } catch (error) {
    if (!(error as Refused).isCancelled) set({ comparisonProblem: (error as Error).message });
  }
}
