// The page as a whole.
import { render } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { ChartView } from "./chart";
import { EditorPane } from "./editor";
import { downloadBundle, openBundle, takeDroppedFiles } from "./files";
import { GraphView } from "./graph";
import { KeysDialog, listenToKeys } from "./keys";
import { Panels, Tabs } from "./panels";
import { makeTurntable, takePicture } from "./pictures";
import { PlanesView, scansToSee } from "./planes";
import { connection, isDirty, listFiles, newFile, openFile, runPython, save } from "./session";
import { SliceView } from "./slices";
import { State, set, state, useStore } from "./store";
import { SurfaceView } from "./surface";
import { VolumeView } from "./volume";

const designViews: { name: State["view"]; title: string }[] = [
  { name: "surface", title: "Surface" },
  { name: "slices", title: "Slices" },
  { name: "volume", title: "Volume" },
  { name: "graph", title: "Graph" },
  { name: "all", title: "All four" },
];

// Returns the views that can be chosen. A table only has charts; a design with a scan also has the planes.
function viewsToSee(): typeof designViews {
  if (state.kind === "table") return [{ name: "chart", title: "Chart" }];
  const planes = { name: "planes" as const, title: "Scan" };
  return scansToSee().length > 0 ? [planes, ...designViews] : designViews;
}

function Status() {
  const { status, isBusy, isOld, saved, file, kind, design } = useStore();
  const text =
    status === "connecting" ? "connecting…"
    : status === "lost" ? "the server is gone; what you type is kept here, and it connects again when it comes back"
    : status === "refused" ? "the server was started again; open the address that it printed, what you typed is kept"
    : !file || kind === "table" ? ""
    : isBusy ? "evaluating…"
    : isOld ? (design ? "the views show the last design without mistakes" : "not yet a design")
    : "up to date";
  const saving = { saved: "saved", unsaved: "not saved yet", saving: "saving…", failed: "not saved" }[saved];
  return (
    <p class={`status ${status}`} role="status" data-status={status} data-busy={isBusy} data-old={isOld} data-saved={saved}>
      {text}
      {file && kind === "" && status === "open" && <span class="saving">{saving}</span>}
    </p>
  );
}

const groups = [
  { kind: "scan", title: "Scans" },
  { kind: "results", title: "Results" },
  { kind: "table", title: "Tables" },
];

function FileChoice() {
  const { files, data, file } = useStore();
  const [isAsking, ask] = useState(false);
  const [problem, setProblem] = useState("");
  const make = async (event: Event) => {
    event.preventDefault();
    const name = new FormData(event.currentTarget as HTMLFormElement).get("name") as string;
    try {
      await newFile(name.trim());
      ask(false);
      setProblem("");
    } catch (error) {
      setProblem((error as Error).message);
    }
  };
  return (
    <span class="controls">
      <label>
        <span class="quiet">Design</span>
        <select class="file" value={file} onFocus={listFiles} onChange={(e) => openFile(e.currentTarget.value)}>
          {!file && <option value="">choose…</option>}
          {data.length === 0 && files.map((name) => <option value={name}>{name}</option>)}
          {data.length > 0 && <optgroup label="Designs">{files.map((name) => <option value={name}>{name}</option>)}</optgroup>}
          {groups.filter((g) => data.some((d) => d.kind === g.kind)).map((g) => (
            <optgroup label={g.title}>{data.filter((d) => d.kind === g.kind).map((d) => <option value={d.name}>{d.name}</option>)}</optgroup>
          ))}
        </select>
      </label>
      {isAsking ? (
        <form class="controls" onSubmit={make}>
          <input name="name" type="text" aria-label="Name of the new design" placeholder="part.vcad" required autofocus />
          <button>Make</button>
          <button type="button" onClick={() => ask(false)}>Cancel</button>
          {problem && <span class="error" role="alert">{problem}</span>}
        </form>
      ) : (
        <button onClick={() => ask(true)}>New</button>
      )}
      {file.endsWith(".py") && <button class="main" onClick={runPython}>Run</button>}
    </span>
  );
}

function PictureButtons() {
  const { design, turntable, kind } = useStore();
  return (
    <span class="controls pictures">
      <button disabled={!design || kind === "table"} onClick={takePicture} title="A picture of the view, as PNG (Alt P)">Picture</button>
      <button disabled={!design || kind === "table"} onClick={() => makeTurntable("webm")} title="The design turned once around, as WebM (Alt T)">
        {turntable === undefined ? "Turntable" : `Stop at ${Math.round(100 * turntable)} %`}
      </button>
      <button disabled={!design || kind === "table" || turntable !== undefined} onClick={() => makeTurntable("gif")} title="The design turned once around, as GIF (Alt G)">
        GIF
      </button>
    </span>
  );
}

function BundleButtons() {
  const { file, kind } = useStore();
  const input = useRef<HTMLInputElement>(null);
  return (
    <span class="controls">
      <button disabled={!file || kind !== "" || file.endsWith(".py")} onClick={downloadBundle} title="The design with the files that it reads, as one file (Alt B)">Download bundle</button>
      <button onClick={() => input.current!.click()} title="A bundle, .ombre; it can also be dropped on the page">Open bundle</button>
      <input ref={input} type="file" accept=".ombre" hidden aria-label="Bundle to open"
             onChange={(e) => { const chosen = e.currentTarget.files?.[0]; if (chosen) openBundle(chosen); e.currentTarget.value = ""; }} />
    </span>
  );
}

function Theme() {
  const { theme } = useStore();
  return (
    <label>
      <span class="quiet">Theme</span>
      <select value={theme} onChange={(e) => set({ theme: e.currentTarget.value as State["theme"] })}>
        <option value="system">system</option>
        <option value="light">light</option>
        <option value="dark">dark</option>
      </select>
    </label>
  );
}

function Views() {
  const { view: wanted, isOld } = useStore();
  const views = viewsToSee();
  const view = views.some((v) => v.name === wanted) ? wanted : views[0].name;
  const isShown = (name: State["view"]) => view === "all" || view === name;
  return (
    <section class={isOld ? "views old" : "views"} aria-label="Views">
      <Tabs label="Views" tabs={views} chosen={view} choose={(name) => set({ view: name })} />
      <PictureButtons />
      {isOld && <p class="oldmark">of an earlier text</p>}
      <div class={view === "all" ? "grid four" : "grid"} role="tabpanel" aria-labelledby={`tab-${view}`}>
        {view === "planes" && <PlanesView />}
        {view === "chart" && <ChartView />}
        {isShown("surface") && <SurfaceView />}
        {isShown("slices") && <SliceView />}
        {isShown("volume") && <VolumeView />}
        {isShown("graph") && <GraphView />}
      </div>
    </section>
  );
}

function App() {
  const { theme, hello } = useStore();
  useEffect(() => {
    takeDroppedFiles();
    listenToKeys();
    connection.connect();
  }, []);
  useEffect(() => {
    document.documentElement.dataset.theme = theme;
  }, [theme]);
  useEffect(() => {
    document.title = `${state.file || "Ombre"} – Ombre Studio`;
  });
  return (
    <>
      <header>
        <h1>Ombre Studio</h1>
        <FileChoice />
        <BundleButtons />
        <Status />
        <span class="folder">{hello?.folder}</span>
        <button onClick={() => set({ showsKeys: true })} title="Keys of the page (Alt K)">Keys</button>
        <Theme />
        <a class="quiet" href="licences.txt" target="_blank" title="Licences of what the page is made of">{hello?.program}</a>
      </header>
      <main>
        <EditorPane />
        <Views />
        <Panels />
      </main>
      <KeysDialog />
    </>
  );
}

addEventListener("beforeunload", () => isDirty() && save());
render(<App />, document.getElementById("app")!);
