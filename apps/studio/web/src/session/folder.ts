// The files of the studio's folder.
import { set, state } from "../store";
import { connection } from "./connection";

export async function listFiles() {
  const { files, data } = await connection.ask("list").answer;
  set({ files, data });
}

export function freeName(stem: string): string {
  const isTaken = (name: string) => state.files.includes(name) || state.hello?.drafts.includes(name);
  for (let n = 1; ; ++n) {
    const name = n === 1 ? `${stem}.vcad` : `${stem}_${n}.vcad`;
    if (!isTaken(name)) return name;
  }
}

// The file that is open when the page comes back to this folder.
const lastKey = () => `ombre:file:${state.hello?.folder}`;
export const lastFile = () => localStorage.getItem(lastKey());
export const keepLastFile = (file: string) => localStorage.setItem(lastKey(), file);
