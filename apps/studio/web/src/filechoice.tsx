// Menus of files for variables that hold a file's name.
import { connection } from "./session/connection";
import { Value, Variable, set, state, useStore } from "./store";

const pattern = /^\*(\.[\w.]+)$/; // "*.stl"

// Returns the endings that the comment of a variable names: // [*.stl, *.obj]
function saidEndings(v: Variable): string[] {
  const found = (v.choices ?? []).map((c) => pattern.exec(String(c.value))?.[1] ?? "");
  return found.includes("") ? [] : found;
}

// Returns the endings of the comment, or else that of the value if there are files with it.
function endingsOf(v: Variable): string[] {
  if (typeof v.value !== "string") return [];
  if (v.kind === "choice") return saidEndings(v).map((e) => e.toLowerCase());
  const ending = /(\.nii)?\.[A-Za-z]\w*$/i.exec(v.value);
  return ending ? [ending[0].toLowerCase()] : [];
}

const filesFor = (v: Variable) => [...new Set(endingsOf(v).flatMap((ending) => state.filesByEnding[ending] ?? []))];

export const mayNameFile = (v: Variable) => saidEndings(v).length > 0 || filesFor(v).length > 0;

// Lists files with endings that are not known yet, or with all endings again.
export async function listFileChoices(isAgain = false) {
  const file = state.file;
  const endings = [...new Set(state.variables.flatMap(endingsOf))].filter((ending) => isAgain || !(ending in state.filesByEnding));
  for (const ending of endings) {
    const reply = await connection.ask("files_ending_in", { file, endings: [ending] }).answer.catch(() => undefined);
    if (!reply || file !== state.file) return;
    set({ filesByEnding: { ...state.filesByEnding, [ending]: reply.files as string[] } });
  }
}

export function FileMenu({ id, v, value, change }: { id: string; v: Variable; value: string; change: (next: Value) => void }) {
  useStore();
  const files = filesFor(v);
  return (
    <select id={id} value={value} onFocus={() => listFileChoices(true)} onChange={(e) => change(e.currentTarget.value)}>
      {!files.includes(value) && <option value={value}>{value ? `${value} (not in the folder)` : "choose…"}</option>}
      {files.map((name) => <option value={name}>{name}</option>)}
    </select>
  );
}
