// The page's side of the connection: what it asks first, after an absence, and which parts the news go to.
import { keptDrafts } from "../kept";
import { hearPresets, listPresets } from "../presets";
import { Hello, set, state } from "../store";
import { Listener, Reply, connection } from "./connection";
import { openFirst } from "./documents";
import { evaluate, hearScript, showData } from "./evaluation";
import { listJobs, takeJob } from "./exports";
import { adoptEarlyText, hearChange, isDirty, save, takeFromDisk, version } from "./saving";

export const session: Listener = {
  opened: () => greet(),
  lost: () => set({ status: "lost", isBusy: false }),
  refused: () => set({ status: "refused" }),
  event: (name, members) => heard(name, members),
};

// Keeps only options that the server knows, since another version of the program may have saved them.
const knownOptions = (hello: Hello) =>
  Object.fromEntries(
    Object.entries(state.options).filter(([name, value]) =>
      name === "printer" ? hello.printers.some((p) => p.name === value) : hello.job_options.some((o) => o.name === name && (o.choices.length === 0 || o.choices.includes(String(value)))),
    ),
  );

async function greet() {
  const wasAway = state.hello !== undefined;
  const hello = (await connection.ask("hello").answer) as any;
  set({ status: "open", hello, files: hello.files, data: hello.data, options: knownOptions(hello) });
  hello.drafts = [...new Set([...hello.drafts, ...keptDrafts()])];
  await listJobs();
  if (wasAway && state.file) await comeBack();
  else if (!(await adoptEarlyText())) await openFirst(hello);
  set({ hasBegun: true });
}

// Continues after the server was away. Text typed meanwhile is kept, unless the disk has something new.
async function comeBack() {
  const disk = await connection.ask("open", { file: state.file }).answer.catch(() => undefined);
  listPresets();
  if (disk && state.kind !== "") return showData(disk);
  if (disk && disk.version !== version) takeFromDisk(disk);
  if (!state.conflict && isDirty()) save();
  evaluate();
}

async function heard(name: string, members: Reply) {
  if (name === "job") return takeJob(members.job);
  if (name === "presets") return hearPresets(members.file, members.presets);
  if (name === "list") return set({ files: members.files, data: members.data });
  if (name === "zipping") return set({ transfer: { name: members.name, share: members.share } });
  if (name === "said") return hearScript(members.file, members.line);
  if (name === "changed") await hearChange(members.file, members.version);
}
