// The form of a job's options, made from the list that the server sends.
import { LateField } from "./latefield";
import { chooseOption } from "./session/exports";
import { JobOption, JobOptions, state, useStore } from "./store";

function control(option: JobOption, value: string | boolean, printers: { name: string; title: string }[], change: (next: string | boolean) => void) {
  if (option.kind === "flag") return <input type="checkbox" checked={value === true} onChange={(e) => change(e.currentTarget.checked)} />;
  const choices = option.name === "printer" ? printers : option.choices.map((name) => ({ name, title: "" }));
  if (choices.length > 0)
    return (
      <select class={option.name} value={value as string} onChange={(e) => change(e.currentTarget.value)}>
        <option value="">usual</option>
        {choices.map((choice) => <option value={choice.name} title={choice.title}>{choice.name}</option>)}
      </select>
    );
  return <LateField type="text" value={value as string} placeholder={option.placeholder} take={(text) => change(text.trim())} />;
}

// A field for one option of any job.
export function OptionField({ option, options, change }: { option: JobOption; options: JobOptions; change: (next: string | boolean) => void }) {
  const { hello } = useStore();
  return (
    <label class={`option option-${option.name}`} title={option.help} hidden={!option.needs.every((needed) => needed in options)}>
      <span>{option.name.replace(/-/g, " ")}{option.is_required ? " *" : ""}</span>
      {control(option, options[option.name] ?? (option.kind === "flag" ? false : ""), hello?.printers ?? [], change)}
    </label>
  );
}

export function OptionControl({ name }: { name: string }) {
  const { hello, options } = useStore();
  const option = hello?.job_options.find((known) => known.name === name);
  if (!option) return null;
  return <OptionField option={option} options={options} change={(next) => chooseOption(option, next)} />;
}

const first = ["printer", "place", "tray"];

// A form in which the first options are open, since they are chosen most; the others are folded, unless some are
// chosen.
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

// Returns the options as words of the command line of `ombre slice`.
export function optionWords(): string[] {
  return Object.entries(state.options).flatMap(([name, value]) => (value === true ? [`--${name}`] : [`--${name}=${/^[\w.,-]+$/.test(String(value)) ? value : `'${value}'`}`]));
}
