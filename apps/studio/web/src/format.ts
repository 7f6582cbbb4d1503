// Indents the lines of a script: statements in braces have two spaces more than the line that opens them. Continuation
// lines move with their first line, so that aligned text stays aligned. Texts in quotes and long comments are left as
// they are.

const step = 2, most_empty_lines = 2;

interface Place {
  braces: number[]; // the indentation of each line that opened one
  brackets: number; // number of open parentheses and square brackets
  inside: "" | "string" | "comment";
  isUnfinished: boolean; // true within a statement
}

// Reads a line without its indentation. Statements in braces that it opens are indented relative to `indent`.
function after(line: string, indent: number, place: Place): Place {
  let { brackets, inside, isUnfinished } = place;
  const braces = [...place.braces];
  if (inside === "" && /^(use|include)\s*<[^>]*>/.test(line)) return { ...place, isUnfinished: false };
  for (let at = 0; at < line.length; ++at) {
    const c = line[at], pair = line.slice(at, at + 2);
    if (inside === "string") {
      if (c === "\\") ++at;
      else if (c === '"') inside = "";
    } else if (inside === "comment") {
      if (pair === "*/") {
        inside = "";
        ++at;
      }
    } else if (pair === "//") break;
    else if (pair === "/*") {
      inside = "comment";
      ++at;
    } else if (!/\s/.test(c)) {
      if (c === '"') inside = "string";
      if (c === "(" || c === "[") ++brackets;
      if (c === ")" || c === "]") brackets = Math.max(0, brackets - 1);
      if (c === "{") braces.push(indent);
      if (c === "}") braces.pop();
      isUnfinished = brackets > 0 || !";{}".includes(c);
    }
  }
  return { braces, brackets, inside, isUnfinished };
}

export function formatted(text: string): string {
  let place: Place = { braces: [], brackets: 0, inside: "", isUnfinished: false };
  let own = 0, shift = 0, empty = 0; // indentation of the current statement, and how far it moved
  let outer = 0; // indentation of the last line that began outside of brackets
  const lines: string[] = [];
  for (const line of text.replaceAll("\r\n", "\n").split("\n")) {
    if (place.inside !== "") {
      place = after(line, own, place);
      lines.push(line);
      empty = 0;
      continue;
    }
    const body = line.trimStart(), spaces = line.slice(0, line.length - body.length).replaceAll("\t", "  ").length;
    if (body === "") {
      if (++empty <= most_empty_lines) lines.push("");
      continue;
    }
    empty = 0;
    const opener = place.braces[place.braces.length - 1];
    let indent = Math.max(own + step, spaces + shift);
    if (body.startsWith("}") || !place.isUnfinished) {
      indent = own = opener === undefined ? 0 : body.startsWith("}") ? opener : opener + step;
      shift = indent - spaces;
    } else if (/^[)\]{]/.test(body)) indent = Math.max(own, spaces + shift);
    if (place.brackets === 0) outer = indent;
    place = after(body, outer, place);
    lines.push(" ".repeat(indent) + (place.inside === "" ? body.trimEnd() : body));
  }
  while (lines.length > 0 && lines[lines.length - 1] === "") lines.pop();
  while (lines[0] === "") lines.shift();
  return lines.join("\n") + (lines.length > 0 ? "\n" : "");
}
