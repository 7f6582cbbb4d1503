// The options of a job, as the command line has them: the server's list of them is the form.
import { chooseOption } from "./session";
import { JobOption, JobOptions, state, useStore } from "./store";

function control(option: JobOption, value: string | boolean, printers: { name: string; title: string }[]) {
  const change = (next: string | boolean) => chooseOption(option, next);
  if (option.kind === "flag") return <input type="checkbox" checked={value === true} onChange={(e) => change(e.currentTarget.checked)} />;
  const choices = option.name === "printer" ? printers : option.choices.map((name) => ({ name, title: "" }));
  if (choices.length > 0)
    return (
      <select class={option.name} value={value as string} onChange={(e) => change(e.currentTarget.value)}>
        <option value="">usual</option>
        {choices.map((choice) => <option value={choice.name} title={choice.title}>{choice.name}</option>)}
      </select>
    );
  return <input type="text" value={value as string} placeholder={option.placeholder} onChange={(e) => change(e.currentTarget.value.trim())} />;
}

export function OptionControl({ name }: { name: string }) {
  const { hello, options } = useStore();
  const option = hello?.job_options.find((known) => known.name === name);
  if (!option) return null;
  const isUsable = option.needs.every((needed) => needed in options);
  return (
    <label class={`option option-${name}`} title={option.help} hidden={!isUsable}>
      <span>{name.replace("-", " ")}</span>
      {control(option, options[name] ?? (option.kind === "flag" ? false : ""), hello!.printers)}
    </label>
  );
}

const first = ["printer", "place", "tray"];

// The first ones are chosen most; the others are folded, unless some are chosen.
export function OptionForm() {
  const { hello, options } = useStore();
  const others = (hello?.job_options ?? []).filter((option) => !first.includes(option.name));
  return (
    <>
      {first.map((name) => <OptionControl name={name} />)}
      <details class="options" open={others.some(({ name }) => name in options)}>
        <summary>More options</summary>
        {others.map(({ name }) => <OptionControl name={name} />)}
      </details>
    </>
  );
}

export const printerOf = (options: JobOptions) => (options.printer as string) || "generic";

// As `ombre slice` takes them.
export function optionWords(): string[] {
  return Object.entries(state.options).flatMap(([name, value]) => (value === true ? [`--${name}`] : [`--${name}=${/^[\w.,-]+$/.test(String(value)) ? value : `'${value}'`}`]));
}
