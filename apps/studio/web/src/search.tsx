// A list that words narrow down.
import { useState } from "preact/hooks";

// Returns the entries of a list that have all words that are typed, and the field for them.
export function useSearch<T>(list: T[], textOf: (entry: T) => string, noun: string) {
  const [words, setWords] = useState("");
  const wanted = words.toLowerCase().split(/\s+/).filter(Boolean);
  const found = list.filter((entry) => wanted.every((word) => textOf(entry).toLowerCase().includes(word)));
  const field = (
    <>
      <label>
        Search
        <input type="search" value={words} onInput={(e) => setWords(e.currentTarget.value)} />
      </label>
      <p class="hint" role="status">{found.length} {found.length === 1 ? noun.replace(/s$/, "") : noun}</p>
    </>
  );
  return { found, field };
}
