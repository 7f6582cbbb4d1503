// Jobs: their options, starting and changing them, and news of them.
import { Job, JobOption, JobOptions, set, state } from "../store";
import { Refused, connection } from "./connection";
import { about, evaluate, plan } from "./evaluation";

// Two jobs with the same key are the same job.
export const jobKey = () => JSON.stringify([state.design?.design, state.options]);

// Sets an option; an empty text, or false, removes it. Options that it excludes are removed.
export function chooseOption(option: JobOption, value: string | boolean) {
  const others = Object.entries(state.options).filter(([name]) => {
    const other = state.hello!.job_options.find((o) => o.name === name);
    return name !== option.name && !(value && (option.excludes.includes(name) || other?.excludes.includes(option.name)));
  });
  const options: JobOptions = Object.fromEntries(value ? [...others, [option.name, value]] : others);
  // Options that need a removed one are removed with it.
  for (const { name, needs } of state.hello!.job_options) if (needs.some((needed) => !(needed in options))) delete options[name];
  set({ options });
  plan();
}

// Turns the part on the tray; the views show it so.
export function turn(rotate: number[]) {
  set({ rotate });
  evaluate(150);
}

export async function openFolder(job: Job) {
  await connection.ask("open_folder", { folder: job.folder }).answer.catch((error) => set({ notice: (error as Error).message }));
}

export async function estimate(): Promise<string> {
  const of = jobKey();
  try {
    set({ estimate: { of, ...((await about("estimate", state.options, "estimate")) as any) } });
    return "";
  } catch (error) {
    return (error as Refused).isCancelled ? "" : (error as Error).message;
  }
}

let heardJobs = new Map<number, Job>(); // news since the list was asked for

// Lists the server's jobs. News that come before the answer are newer than it.
export async function listJobs() {
  heardJobs = new Map();
  const { jobs } = await connection.ask("jobs").answer;
  set({ jobs: [...jobs.filter((job: Job) => !heardJobs.has(job.id)), ...heardJobs.values()] });
}

export function takeJob(job: Job) {
  heardJobs.set(job.id, job);
  set({ jobs: [...state.jobs.filter((known) => known.id !== job.id && known.path !== job.path), job] });
  dispatchEvent(new Event("jobs"));
}

// Takes a job that was just started. News of it may have come before.
export function noteJob(job: Job) {
  if (state.jobs.some((known) => known.id === job.id)) dispatchEvent(new Event("jobs"));
  else takeJob(job);
}

export async function startExport(folder: string, replace: boolean): Promise<string> {
  try {
    const reply = await about("export", { folder, file: state.file, replace, ...state.options }, "");
    noteJob(reply.job);
    return "";
  } catch (error) {
    return (error as Error).message;
  }
}

// Starts a job of any kind. Returns a message if that fails.
export async function startKind(kind: string, options: JobOptions, replace: boolean): Promise<string> {
  try {
    const given = Object.fromEntries(Object.entries(options).filter(([, value]) => value !== "" && value !== false));
    noteJob((await about("run", { kind, file: state.file, options: given, replace }, "")).job);
    return "";
  } catch (error) {
    return (error as Error).message;
  }
}

export async function changeJob(job: Job, to: "pause" | "resume" | "cancel") {
  await connection.ask("change_export", { job: job.id, to }).answer.catch((error) => set({ notice: (error as Error).message }));
}
