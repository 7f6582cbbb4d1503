// A slider with a field for the exact number beside it.
import { LateField } from "./latefield";

interface Range {
  id?: string;
  label: string;
  min: number;
  max: number;
  step: number | "any";
  value: number;
  take: (value: number) => void;
  valueText?: string;
  isDisabled?: boolean;
}

export function Slider({ id, label, min, max, step, value, take, valueText, isDisabled }: Range) {
  const exact = (text: string) => {
    if (text !== "" && isFinite(+text)) take(Math.max(min, Math.min(max, +text)));
  };
  return (
    <span class="slider">
      <input id={id} type="range" aria-label={label} title={label} aria-valuetext={valueText} min={min} max={max} step={step} value={value} disabled={isDisabled} onInput={(e) => take(+e.currentTarget.value)} />
      <LateField class="exact" type="number" aria-label={`${label}, exactly`} min={min} max={max} step="any" value={+value.toPrecision(6)} disabled={isDisabled} take={exact} />
    </span>
  );
}
