// Starts jobs of all kinds; their forms are made from the options that the server lists.
import { useState } from "preact/hooks";
import { JobList } from "./joblist";
import { OptionField } from "./joboptions";
import { startKind } from "./session/exports";
import { JobKind, JobOptions, useStore } from "./store";

function KindForm({ kind }: { kind: JobKind }) {
  const { file, design, isOld } = useStore();
  const [options, setOptions] = useState<JobOptions>({});
  const [replace, setReplace] = useState(false);
  const [problem, setProblem] = useState("");
  const change = (name: string, next: string | boolean) => {
    const others = Object.entries(options).filter(([other]) => other !== name);
    setOptions(Object.fromEntries(next === "" || next === false ? others : [...others, [name, next]]));
  };
  const field = (option: JobKind["options"][number]) => (
    <OptionField option={option} options={options} change={(next) => change(option.name, next)} />
  );
  const isFirst = (option: JobKind["options"][number]) => option.is_required || ["output", "printer", "voxel", "by", "what", "at", "study", "cell", "solve"].includes(option.name);
  const shown = kind.options.filter(({ name }) => name !== "force");
  return (
    <form onSubmit={async (e) => {
      e.preventDefault();
      setProblem(await startKind(kind.name, options, replace));
    }}>
      <p class="hint">{kind.help}.</p>
      {shown.filter(isFirst).map(field)}
      <details class="options">
        <summary>More options</summary>
        {shown.filter((option) => !isFirst(option)).map(field)}
      </details>
      <label class="option">
        <input type="checkbox" checked={replace} onChange={(e) => setReplace(e.currentTarget.checked)} />
        Replace what is there
      </label>
      <div class="buttons">
        <button class="main" type="submit" disabled={!file || !design || isOld}>{kind.name === "info" ? "Show" : `Start ${kind.name}`}</button>
      </div>
      {problem && <p class="error" role="alert">{problem}</p>}
    </form>
  );
}

export function Kinds() {
  const { hello } = useStore();
  const [name, setName] = useState("mesh");
  const kinds = hello?.kinds ?? [];
  const kind = kinds.find((known) => known.name === name);
  return (
    <div class="panelbody">
      <label class="option option-kind">
        <span>kind</span>
        <select class="kind" value={name} onChange={(e) => setName(e.currentTarget.value)}>
          {kinds.map((known) => <option value={known.name} title={known.help}>{known.name}</option>)}
        </select>
      </label>
      {kind && <KindForm key={kind.name} kind={kind} />}
      <JobList />
    </div>
  );
}
