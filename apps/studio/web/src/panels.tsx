// The panels beside the views: variables, materials, slicing, the reference of nodes.
import { useState } from "preact/hooks";
import { Examples } from "./examples";
import { FileMenu, mayNameFile } from "./filechoice";
import { JobList } from "./joblist";
import { OptionForm, optionWords } from "./joboptions";
import { Kinds } from "./kinds";
import { LateField } from "./latefield";
import { NumberField } from "./numberfield";
import { Presets } from "./presets";
import { Reference } from "./reference";
import { resetVariables, setVariable, writeVariables } from "./session/evaluation";
import { estimate, jobKey, startExport, turn } from "./session/exports";
import { compare, forgetMark, markVersion, measure } from "./session/measures";
import { Slider } from "./slider";
import { Amount, State, Value, Variable, set, state, useStore } from "./store";

function numberRange(v: Variable): { min: number; max: number; step: number | "any" } {
  const value = v.value as number;
  const most = v.most ?? (value === 0 ? 10 : 2 * Math.abs(value));
  const least = v.least ?? (value < 0 ? -most : 0);
  return { min: least, max: most, step: v.step ?? (Number.isInteger(value) && most - least >= 10 ? 1 : (most - least) / 100) };
}

function Control({ v, value }: { v: Variable; value: Value }) {
  const id = `variable-${v.name}`;
  const change = (next: Value) => setVariable(v.name, next);
  if (v.kind === "boolean") return <input id={id} type="checkbox" checked={value as boolean} onChange={(e) => change(e.currentTarget.checked)} />;
  if (mayNameFile(v)) return <FileMenu id={id} v={v} value={value as string} change={change} />;
  if (v.kind === "choice")
    return (
      <select id={id} value={JSON.stringify(value)} onChange={(e) => change(JSON.parse(e.currentTarget.value))}>
        {v.choices!.map((c) => <option value={JSON.stringify(c.value)}>{c.label}</option>)}
      </select>
    );
  if (v.kind === "text") return <LateField id={id} type="text" maxLength={v.longest} value={value as string} take={change} />;
  if (v.kind === "vector")
    return (
      <span class="vector">
        {(value as number[]).map((n, at) => (
          <LateField id={at === 0 ? id : undefined} type="number" aria-label={`${v.name}, number ${at + 1}`} step={v.step ?? "any"} value={n}
                     take={(text) => change((value as number[]).map((old, k) => (k === at ? +text : old)))} />
        ))}
      </span>
    );
  const range = numberRange(v);
  return (
    <span class="number">
      <input id={id} type="range" {...range} value={value as number} onInput={(e) => change(+e.currentTarget.value)} />
      <NumberField aria-label={`${v.name}, exactly`} value={value as number} take={change} />
    </span>
  );
}

function Variables() {
  const { variables, values, file, kind } = useStore();
  const isChanged = Object.keys(values).length > 0;
  let section = "";
  return (
    <div class="panelbody">
      {variables.length === 0 && <p>{file ? "The script has no top-level variables with plain values." : "No design is open."}</p>}
      {variables.length > 0 && <Presets key={file} />}
      {variables.map((v) => {
        const heading = v.section && v.section !== section ? v.section : "";
        section = v.section ?? section;
        return (
          <div class={v.name in values ? "variable changed" : "variable"}>
            {heading && <h2>{heading}</h2>}
            <label for={`variable-${v.name}`} title={v.description}>{v.name}</label>
            <Control v={v} value={values[v.name] ?? v.value} />
            {v.description && <p class="hint">{v.description}</p>}
          </div>
        );
      })}
      {variables.length > 0 && (
        <p class="controls">
          <button disabled={!isChanged || kind !== ""} onClick={writeVariables}>Write into the script</button>
          <button disabled={!isChanged} onClick={resetVariables}>Reset</button>
        </p>
      )}
    </div>
  );
}

const volumeText = (mm3: number) => (mm3 >= 1000 ? `${(mm3 / 1000).toPrecision(4)} cm³` : `${mm3.toPrecision(4)} mm³`);

// Shows what the design has gained and lost since a marked version.
function Versions() {
  const { design, mark, comparison: known, comparisonProblem, isOld } = useStore();
  if (!design) return null;
  const found = known && known.mark === mark && known.design === design.design ? known : undefined;
  const rows: [string, number][] = found ? [["gained", found.gained_mm3], ["lost", found.lost_mm3], ["of other material", found.changed_mm3], ["unchanged", found.unchanged_mm3]] : [];
  return (
    <div class="versions">
      <p class="controls">
        <button disabled={isOld} onClick={markVersion}>Mark this version</button>
        <button disabled={!mark || isOld} onClick={compare}>Compare</button>
        {mark && <button onClick={forgetMark}>Forget the mark</button>}
      </p>
      {mark && <p class="hint">Marked: {mark.file} at {mark.time}</p>}
      {found && (
        <table aria-label="Since the marked version">
          <tbody>{rows.map(([name, mm3]) => <tr><th scope="row">{name}</th><td>{volumeText(mm3)}</td></tr>)}</tbody>
        </table>
      )}
      {found && <p class="hint">From voxels of {found.pitch_mm} mm.</p>}
      {comparisonProblem && <p class="error" role="alert">{comparisonProblem}</p>}
    </div>
  );
}

const amountText = (amount: Amount) =>
  volumeText(amount.volume_mm3) + (amount.mass_g === undefined ? "" : `, ${amount.mass_g.toPrecision(4)} g`);

function Materials() {
  const { design, opacity, measure: known } = useStore();
  const measured = known && design && known.design === design.design ? known : undefined;
  return (
    <div class="panelbody">
      {!design && <p>Nothing yet.</p>}
      {design?.materials.map((m) => {
        const usual = (m.colour[3] ?? 255) / 255;
        const own = measured?.materials.find((x) => x.name === m.name);
        return (
          <div class="material">
            <span class="swatch" style={{ background: `rgb(${m.colour.slice(0, 3).join(",")})` }} />
            <label for={`opacity-${m.name}`}>{m.name}</label>
            <Slider id={`opacity-${m.name}`} label={`Opacity of ${m.name}`} min={0} max={1} step={0.01} value={opacity[m.name] ?? usual}
                    take={(value) => set({ opacity: { ...state.opacity, [m.name]: value } })} />
            {own && <span class="amount">{amountText(own)}</span>}
          </div>
        );
      })}
      {design && (
        <p class="controls">
          <button onClick={measure}>Measure volumes</button>
          <button disabled={Object.keys(opacity).length === 0} onClick={() => set({ opacity: {} })}>Reset opacities</button>
        </p>
      )}
      {measured?.parts && (
        <dl class="parts" aria-label="Parts">
          {measured.parts.filter((part) => part.volume_mm3 > 0).map((part) => (
            <>
              <dt>{part.name}</dt>
              <dd>{amountText(part)}</dd>
            </>
          ))}
        </dl>
      )}
      {measured && <p class="hint">{volumeText(measured.volume_mm3)} in all, from voxels of {measured.pitch_mm} mm.</p>}
      <Versions />
      {design && (
        <p class="hint">
          {design.bounds_mm[1].map((v, n) => `${+(v - design.bounds_mm[0][n]).toPrecision(5)}`).join(" × ")} mm
        </p>
      )}
    </div>
  );
}

function commandLine(folder: string): string {
  const words = ["ombre", "slice", state.file];
  words.push(...optionWords());
  if (state.rotate.some((degrees) => degrees !== 0)) words.push("--rotate", state.rotate.join());
  for (const [name, value] of Object.entries(state.values)) words.push("-D", `'${name}=${JSON.stringify(value)}'`);
  return [...words, "-o", folder].join(" ");
}

function bytesText(bytes: number): string {
  const power = Math.min(4, Math.floor(Math.log(Math.max(bytes, 1)) / Math.log(1024)));
  return `${+(bytes / 1024 ** power).toPrecision(3)} ${["B", "KiB", "MiB", "GiB", "TiB"][power]}`;
}

function durationText(seconds: number): string {
  if (seconds < 90) return `${seconds < 10 ? seconds.toPrecision(2) : Math.round(seconds)} s`;
  return seconds < 5400 ? `${Math.round(seconds / 60)} min` : `${(seconds / 3600).toPrecision(2)} h`;
}

function EstimateText() {
  const { estimate: known } = useStore();
  if (!known || known.of !== jobKey()) return null;
  return (
    <div class="estimate" role="status">
      <p class="hint">
        {known.is_least ? `More than ${durationText(known.seconds)}` : `About ${durationText(known.seconds)}, ${bytesText(known.bytes)} of images`}, at most{" "}
        {bytesText(known.memory_bytes)} of memory
      </p>
      {known.free_bytes !== undefined && known.bytes > known.free_bytes && <p class="error">The disk has {bytesText(known.free_bytes)} left.</p>}
      {known.checks.map((text) => <p class="warning">{text}</p>)}
    </div>
  );
}

function Turns() {
  const { rotate } = useStore();
  const set = (axis: number, degrees: number) => turn(rotate.map((old, n) => (n === axis ? degrees : old)));
  return (
    <fieldset class="turns">
      <legend title="About x first, then y, then z">Turn, degrees</legend>
      {["x", "y", "z"].map((name, axis) => (
        <span class="controls">
          <label>
            {name}
            <LateField type="number" step="any" value={rotate[axis]} aria-label={`Turn about ${name}`} take={(text) => set(axis, +text || 0)} />
          </label>
          <button aria-label={`90 degrees more about ${name}`} onClick={() => set(axis, ((rotate[axis] + 270) % 360) - 180)}>+90</button>
        </span>
      ))}
    </fieldset>
  );
}

function Export() {
  const { plan, planProblem, file, kind, design, isOld } = useStore();
  const [given, setFolder] = useState("");
  const [replace, setReplace] = useState(false);
  const [problem, setProblem] = useState("");
  const folder = given || (file ? `${file.replace(/\.[^.]*$/, "")}_slices` : "");
  const voxels = plan ? plan.count[0] * plan.count[1] * plan.count[2] : 0;
  return (
    <div class="panelbody">
      <OptionForm />
      <Turns />
      {plan && (
        <p class="hint">
          {plan.title}: {plan.count[2]} layers of {plan.count[0]} × {plan.count[1]} pixels, {voxels.toLocaleString("en")} voxels
        </p>
      )}
      {planProblem && <p class="error">{planProblem}</p>}
      {plan?.remarks.map((r) => <p class={r.severity}>{r.message}</p>)}
      <label>
        Folder
        <input type="text" value={folder} onInput={(e) => setFolder(e.currentTarget.value)} />
      </label>
      <label>
        <input type="checkbox" checked={replace} onChange={(e) => setReplace(e.currentTarget.checked)} />
        Replace another job that is there
      </label>
      <p class="controls">
        <button class="main" disabled={!plan || !design || isOld || planProblem !== ""} onClick={async () => setProblem(await startExport(folder, replace))}>Slice</button>
        <button disabled={!plan || !design || isOld || planProblem !== ""} onClick={async () => setProblem(await estimate())}>Estimate</button>
      </p>
      <EstimateText />
      {problem && <p class="error" role="alert">{problem}</p>}
      <JobList />
      {plan && (
        <>
          {!file.endsWith(".scad") && kind === "" && (
            <details>
              <summary>The same on the command line</summary>
              <pre tabIndex={0}>{commandLine(folder)}</pre>
            </details>
          )}
          <details>
            <summary>job.json</summary>
            <pre tabIndex={0}>{plan.job}</pre>
          </details>
        </>
      )}
    </div>
  );
}

const panels: { name: State["panel"]; title: string; body: () => any }[] = [
  { name: "variables", title: "Variables", body: Variables },
  { name: "materials", title: "Materials", body: Materials },
  { name: "export", title: "Slice", body: Export },
  { name: "jobs", title: "Jobs", body: Kinds },
  { name: "reference", title: "Nodes", body: Reference },
  { name: "examples", title: "Examples", body: Examples },
];

export function Tabs<T extends string>({ label, tabs, chosen, choose }: { label: string; tabs: { name: T; title: string }[]; chosen: T; choose: (name: T) => void }) {
  const onKeyDown = (event: KeyboardEvent) => {
    const step = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    if (step === 0) return;
    const n = (tabs.findIndex((t) => t.name === chosen) + step + tabs.length) % tabs.length;
    choose(tabs[n].name);
    ((event.currentTarget as HTMLElement).children[n] as HTMLElement).focus();
  };
  return (
    <div class="tabs" role="tablist" aria-label={label} onKeyDown={onKeyDown}>
      {tabs.map((t) => (
        <button role="tab" id={`tab-${t.name}`} aria-selected={t.name === chosen} tabIndex={t.name === chosen ? 0 : -1} onClick={() => choose(t.name)}>
          {t.title}
        </button>
      ))}
    </div>
  );
}

export function Panels() {
  const { panel } = useStore();
  const Body = panels.find((p) => p.name === panel)!.body;
  return (
    <section class="panels" aria-label="Panels">
      <Tabs label="Panels" tabs={panels} chosen={panel} choose={(name) => set({ panel: name })} />
      <div role="tabpanel" aria-labelledby={`tab-${panel}`} class="panel" tabIndex={0}>
        <Body />
      </div>
    </section>
  );
}
