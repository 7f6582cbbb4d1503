// Presets: the sliders' values under a name, in a file beside the script.
import { useState } from "preact/hooks";
import { Refused, connection } from "./session/connection";
import { resetVariables, setValues } from "./session/evaluation";
import { Preset, Value, Variable, set, state, useStore } from "./store";

// Takes a list of presets; answers about a file that is no longer open are ignored.
export function hearPresets(file: string, presets: Preset[]) {
  if (file !== state.file) return;
  const isThere = presets.some((p) => p.name === state.preset);
  set({ presets, preset: isThere ? state.preset : "", presetsProblem: "" });
}

async function ask(what: string, members: Record<string, unknown>): Promise<string> {
  const file = state.file;
  try {
    const reply = await connection.ask(what, { file, ...members }).answer;
    hearPresets(file, reply.presets as Preset[]);
    return "";
  } catch (error) {
    return (error as Refused).message;
  }
}

export async function listPresets() {
  const file = state.file;
  if (file.endsWith(".py") || file.endsWith(".json") || state.kind === "table") return;
  const presetsProblem = await ask("presets", {});
  if (file === state.file) set({ presetsProblem });
}

async function savePreset(name: string, replace: boolean): Promise<string> {
  const file = state.file;
  const values = Object.fromEntries(state.variables.map((v) => [v.name, state.values[v.name] ?? v.value]));
  const problem = await ask("save_preset", { name, values, replace });
  if (!problem && file === state.file) set({ preset: name });
  return problem;
}

const isVector = (value: unknown) => Array.isArray(value) && value.every((n) => typeof n === "number");

// Returns a preset's value in the type of the variable; nothing if it has another kind.
function valueOf(variable: Variable, text: string): Value | undefined {
  if (typeof variable.value === "string") return text;
  try {
    const value = JSON.parse(text);
    const fits = isVector(variable.value) ? isVector(value) : typeof value === typeof variable.value;
    return fits ? value : undefined;
  } catch {
    return undefined;
  }
}

const isSame = (a: Value, b: Value) => JSON.stringify(a) === JSON.stringify(b);

// Returns the values of the script's variables: those of the preset, else those of the text.
function valuesOf(preset: Preset): Record<string, Value> {
  const values: Record<string, Value> = {};
  for (const v of state.variables) {
    const value = Object.hasOwn(preset.values, v.name) ? valueOf(v, preset.values[v.name]) : undefined;
    if (value !== undefined && !isSame(value, v.value)) values[v.name] = value;
  }
  return values;
}

function leftOut(preset: Preset): string[] {
  return Object.keys(preset.values).filter((name) => {
    const variable = state.variables.find((v) => v.name === name);
    return !variable || valueOf(variable, preset.values[name]) === undefined;
  });
}

function choosePreset(name: string) {
  const preset = state.presets.find((p) => p.name === name);
  if (!preset) return resetVariables();
  set({ preset: name });
  setValues(valuesOf(preset));
}

function isChanged(preset: Preset): boolean {
  const values = valuesOf(preset);
  return state.variables.some((v) => !isSame(state.values[v.name] ?? v.value, values[v.name] ?? v.value));
}

function SaveForm({ close }: { close: () => void }) {
  const { preset, presets } = useStore();
  const [name, setName] = useState(preset);
  const [problem, setProblem] = useState("");
  const isThere = presets.some((p) => p.name === name.trim());
  const save = async (event: Event) => {
    event.preventDefault();
    const found = await savePreset(name.trim(), isThere);
    setProblem(found);
    if (!found) close();
  };
  return (
    <form class="controls" onSubmit={save}>
      <input type="text" aria-label="Name of the preset" maxLength={100} value={name} required autofocus onInput={(e) => setName(e.currentTarget.value)} />
      <button>{isThere ? "Replace" : "Save"}</button>
      <button type="button" onClick={close}>Cancel</button>
      {problem && <span class="error" role="alert">{problem}</span>}
    </form>
  );
}

export function Presets() {
  const { presets, preset, presetsProblem } = useStore();
  const [isSaving, setSaving] = useState(false);
  const [problem, setProblem] = useState("");
  const chosen = presets.find((p) => p.name === preset);
  const unused = chosen ? leftOut(chosen) : [];
  return (
    <div class="presets">
      <label>
        Preset
        <select class="preset" value={preset} onFocus={listPresets} onChange={(e) => choosePreset(e.currentTarget.value)}>
          <option value="">as in the script</option>
          {presets.map((p) => <option value={p.name}>{p === chosen && isChanged(p) ? `${p.name} (changed)` : p.name}</option>)}
        </select>
      </label>
      {isSaving ? (
        <SaveForm close={() => setSaving(false)} />
      ) : (
        <p class="controls">
          <button disabled={presetsProblem !== ""} onClick={() => setSaving(true)}>Save as a preset</button>
          <button disabled={!chosen} onClick={async () => setProblem(await ask("delete_preset", { name: preset }))}>Delete preset</button>
        </p>
      )}
      {unused.length > 0 && <p class="hint">The script has no such variables, or values of another kind: {unused.join(", ")}</p>}
      {problem && <p class="error" role="alert">{problem}</p>}
      {presetsProblem && <p class="hint">{presetsProblem}</p>}
    </div>
  );
}
