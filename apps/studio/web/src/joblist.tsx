// The list of this server's jobs, of all kinds.
import { useState } from "preact/hooks";
import { downloadJob } from "./files";
import { printerOf } from "./joboptions";
import { changeJob, openFolder } from "./session/exports";
import { Job, useStore } from "./store";

function timeLeft(seconds: number): string {
  if (seconds < 0) return "";
  return seconds < 90 ? `${Math.ceil(seconds)} s left` : `${Math.ceil(seconds / 60)} min left`;
}

// Shows a job's report: text as it is, events as names and values.
function Report({ job }: { job: Job }) {
  const events = (job.report ?? []).filter(({ event }) => event !== "plan");
  if (events.length === 0) return null;
  const text = ({ event, ...members }: Record<string, unknown>) =>
    event === "text" ? String(members.text) : Object.entries(members).map(([name, value]) => `${name.replace(/_/g, " ")}: ${typeof value === "string" ? value : JSON.stringify(value)}`).join("\n");
  return (
    <details class="report" open={events.length < 4}>
      <summary>Report</summary>
      <pre tabIndex={0}>{events.map(text).join("\n\n")}</pre>
    </details>
  );
}

function JobRow({ job }: { job: Job }) {
  const share = job.total > 0 ? job.done / job.total : 0;
  const isSlice = job.kind === "slice";
  const may = (...states: Job["state"][]) => states.includes(job.state);
  return (
    <li class="job" data-state={job.state} data-folder={job.folder} data-kind={job.kind}>
      <span>
        <strong>{job.folder}</strong> {isSlice ? printerOf(job.options) : job.kind}: {job.state}
      </span>
      <progress value={share} max={1} aria-label={`Progress of ${job.folder}`} />
      <span>
        {may("working") && `${Math.floor(100 * share)} %, ${timeLeft(job.seconds_left)}`}
        {may("done") && isSlice && `${job.layers} layers`}
      </span>
      {job.message && <p class="error">{job.message}</p>}
      <Report job={job} />
      {may("done") && job.path && job.path !== job.folder && !job.is_download && <JobFolder job={job} />}
      <span class="controls">
        {may("done") && job.path && job.path !== job.folder && <button onClick={() => downloadJob(job)}>{isSlice ? "Download as zip" : "Download"}</button>}
        {may("working", "waiting") && <button onClick={() => changeJob(job, "pause")}>Pause</button>}
        {may("paused", "cancelled", "failed", "interrupted") && <button onClick={() => changeJob(job, "resume")}>{job.resumes ? "Resume" : "Start again"}</button>}
        {may("working", "waiting", "paused", "interrupted") && <button onClick={() => changeJob(job, "cancel")}>Cancel</button>}
      </span>
    </li>
  );
}

function JobFolder({ job }: { job: Job }) {
  const { hello } = useStore();
  const [isCopied, setCopied] = useState(false);
  return (
    <>
      <code class="path">{job.path}</code>
      <span class="controls">
        <button onClick={() => navigator.clipboard.writeText(job.path).then(() => setCopied(true))}>{isCopied ? "Copied" : "Copy path"}</button>
        {hello?.opens_folders && <button onClick={() => openFolder(job)}>Open folder</button>}
      </span>
    </>
  );
}

export function JobList() {
  const { jobs } = useStore();
  return <ul class="jobs" aria-label="Jobs">{jobs.map((job) => <JobRow job={job} />)}</ul>;
}
