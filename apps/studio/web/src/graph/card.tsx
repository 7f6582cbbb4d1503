// A card of the graph: a call with its inputs, outputs and values.
import { LateField } from "../latefield";
import { editGraph, moveValues } from "../session/graph";
import { Shown } from "../store";
import { Thumbnail } from "../thumbnails";
import { Place, Row, heightOf, sizes } from "./layout";
import { Card, Input, isNamed, numberOf, rangeOf } from "./model";

// An end of a wire, as the canvas is told of it.
export interface End {
  item: number;
  side: "input" | "output" | "children";
  n: number;
}

interface Props {
  card: Card;
  place: Place;
  rows: Row[];
  shown?: Shown; // by its picture
  isOpen: boolean;
  isSelected: boolean;
  isFocus: boolean; // the one card that Tab reaches
  pending?: End;
  onFocus: () => void;
  onPort: (end: End) => void;
  onGrab: (event: PointerEvent) => void;
  onPull: (event: PointerEvent, end: End) => void;
  onOpen: () => void;
  onLine: () => void;
  onKey: (event: KeyboardEvent) => void;
}

const target = (card: Card, input: Input) => ({ item: card.item, ...(input.index === undefined ? { name: input.name } : { index: input.index }) });
const put = (card: Card, input: Input, value: string) => editGraph({ edit: "set", ...target(card, input), value });

function move(card: Card, input: Input, number: number) {
  const edit = { edit: "set", ...target(card, input), value: String(+number.toPrecision(6)) };
  moveValues(() => [edit], { event: "input.type" });
}

const hintOf = (input: Input) => {
  const p = input.parameter;
  return p ? [p.doc, p.unit].filter(Boolean).join(", ") : "";
};

function usualOf(input: Input): string {
  const usual = input.parameter?.written_default ?? input.parameter?.default ?? "";
  return typeof usual === "string" ? usual : JSON.stringify(usual);
}

function Value({ card, input }: { card: Card; input: Input }) {
  const label = `${input.name} of ${card.of.variable || card.title}`;
  const isDisabled = card.isLocked;
  const choices = input.parameter?.widget === "boolean" ? ["true", "false"] : (input.parameter?.choices ?? []).map((word) => JSON.stringify(word));
  if (choices.length > 0 && input.from.length === 0 && (input.text === "" || choices.includes(input.text)))
    return (
      <select aria-label={label} value={input.text} disabled={isDisabled} onChange={(e) => put(card, input, e.currentTarget.value)}>
        {input.text === "" && <option value="">{usualOf(input)}</option>}
        {choices.map((word) => <option value={word}>{word.replaceAll('"', "")}</option>)}
      </select>
    );
  const number = input.from.length === 0 ? numberOf(input.text) : undefined;
  return (
    <>
      {number !== undefined && (
        <input type="range" aria-label={`Slider for ${label}`} {...rangeOf(card, input, number)} value={number} disabled={isDisabled} tabIndex={-1}
               onInput={(e) => move(card, input, +e.currentTarget.value)} />
      )}
      <LateField type="text" class={number === undefined ? "text" : "text short"} aria-label={label} title={input.text} value={input.text} placeholder={usualOf(input)} disabled={isDisabled}
                 take={(text) => put(card, input, text)} />
    </>
  );
}

function Port({ card, side, n, type, label, props }: { card: Card; side: End["side"]; n: number; type: string; label: string; props: Props }) {
  const { pending } = props;
  const isPending = pending !== undefined && pending.item === card.item && pending.side === side && pending.n === n;
  return (
    <button class={`dot ${side} type-${type}`} data-end={`${card.item} ${side} ${n}`} aria-label={label} aria-pressed={isPending} title={`${label}: ${type}`} disabled={card.isLocked && side !== "output"}
            onPointerDown={(e) => props.onPull(e, { item: card.item, side, n })} onClick={(e) => e.detail === 0 && props.onPort({ item: card.item, side, n })} />
  );
}

function CardRow({ row, props }: { row: Row; props: Props }) {
  const { card } = props;
  const name = card.of.variable || card.title;
  if (row.kind === "more")
    return <button class="more" aria-expanded={props.isOpen} onClick={props.onOpen}>{props.isOpen ? "▴ fewer" : "▾ more inputs"}</button>;
  if (row.kind === "children")
    return (
      <>
        <Port card={card} side="children" n={0} type="solid" label={`Solids in ${name}`} props={props} />
        <span class="name">{card.of.kind === "group" ? `${card.holds || card.children.length} inside` : "solids"}</span>
      </>
    );
  if (row.kind === "output") {
    const output = card.outputs[row.n];
    return (
      <>
        <span class="name end">{output.name || (output.type === "other" ? "value" : output.type)}</span>
        <Port card={card} side="output" n={row.n} type={output.type} label={`Output ${output.name || "value"} of ${name}`} props={props} />
      </>
    );
  }
  const input = card.inputs[row.n];
  return (
    <>
      <Port card={card} side="input" n={row.n} type={input.type} label={`Input ${input.name} of ${name}`} props={props} />
      <span class="name" title={hintOf(input)}>{input.name}{input.isRequired && input.index === undefined ? " *" : ""}</span>
      <Value card={card} input={input} />
    </>
  );
}

function summary(card: Card): string {
  const given = card.inputs.filter((i) => i.index !== undefined).map((i) => `${i.name} ${i.text}`);
  const where = card.of.parent === undefined ? "" : card.of.kind === "value" ? ", in an argument" : "";
  return `${card.of.variable ? `${card.of.variable}, ` : ""}${card.title}, line ${card.of.line}${where}${card.of.locked_by ? `, made by ${card.of.locked_by}` : ""}${given.length > 0 ? `: ${given.join(", ")}` : ""}`;
}

function Head({ props }: { props: Props }) {
  const { card, shown } = props;
  const { of } = card;
  const isGroup = of.kind === "group";
  return (
    <div class="head" onPointerDown={props.onGrab} onDblClick={isGroup ? props.onOpen : undefined}>
      {isGroup && <button class="fold" aria-expanded={props.isOpen} aria-label={`What ${card.title} holds`} onClick={props.onOpen}>{props.isOpen ? "▾" : "▸"}</button>}
      <span class="title">
        {isNamed(of) ? (
          <LateField type="text" class="variable" aria-label={`Name of ${of.variable}`} value={of.variable} disabled={card.isLocked} take={(name) => editGraph({ edit: "rename", item: card.item, name })} />
        ) : (
          <strong>{isGroup && of.variable ? `module ${of.variable}` : card.title}</strong>
        )}
        <small>
          {isNamed(of) && (of.callee || of.kind === "part") ? `${card.title}, ` : ""}
          <button class="line" aria-label={`${card.title} in line ${of.line} of the script`} onClick={props.onLine}>line {of.line}</button>
          {of.locked_by ? " · read-only" : ""}
        </small>
      </span>
      {shown && <Thumbnail of={shown} type={card.title} />}
    </div>
  );
}

export function CardView(props: Props) {
  const { card, place, rows } = props;
  const style = { left: place.x, top: place.y, width: sizes.width, height: heightOf(rows) };
  const state = [props.isSelected ? "selected" : "", card.isLocked ? "locked" : "", card.of.kind].join(" ");
  return (
    <div class={`card ${state}`} style={style} role="group" tabIndex={props.isFocus ? 0 : -1} aria-label={summary(card)} data-item={card.item} data-key={card.key} onFocus={props.onFocus} onKeyDown={props.onKey}>
      <Head props={props} />
      {rows.map((row) => <div class={`row ${row.kind}`} key={`${row.kind} ${row.n}`}><CardRow row={row} props={props} /></div>)}
    </div>
  );
}
