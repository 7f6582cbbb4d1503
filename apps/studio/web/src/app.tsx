// The page as a whole.
import { render } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { AskingDialog } from "./asking";
import { ChartView } from "./chart";
import { EditorPane } from "./editor";
import {
  copyLink, deleteDesign, downloadBundle, downloadMesh, duplicateDesign, makeDesign, newFolder, openableEndings, openChosen, renameDesign, takeDroppedFiles, watchDownloads,
} from "./files";
import { GraphView } from "./graph/graph";
import { watchView } from "./kept";
import { KeysDialog, listenToKeys } from "./keys";
import { Menu } from "./menu";
import { Panels, Tabs } from "./panels";
import { makeTurntable, takePicture } from "./pictures";
import { PlanesView, scansToSee } from "./planes";
import { connection } from "./session/connection";
import { openFile, runPython } from "./session/documents";
import { stopPython } from "./session/evaluation";
import { listFiles } from "./session/folder";
import { isDirty, save } from "./session/saving";
import { session } from "./session/session";
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

function statusText(): string {
  const { status, isBusy, isOld, isRunning, file, kind, design, transfer, turntable } = state;
  if (transfer) return `${transfer.name}: ${Math.floor(100 * transfer.share)} %`;
  if (turntable !== undefined) return `turntable: ${Math.round(100 * turntable)} %`;
  if (status === "connecting") return "connecting…";
  if (status === "lost") return "the server is gone; what you type is kept here, and it connects again when it comes back";
  if (status === "refused") return "this address lacks the server's token; open the one that it printed, what you typed is kept";
  if (!file || kind === "table") return "";
  if (isRunning) return "running…";
  if (isBusy) return "evaluating…";
  if (isOld) return design ? "the views show the last design without mistakes" : "not yet a design";
  return "up to date";
}

function Status() {
  const { status, isBusy, isOld, saved, file, kind, transfer } = useStore();
  const text = statusText();
  const saving = { saved: "saved", unsaved: "not saved yet", saving: "saving…", failed: "not saved" }[saved];
  return (
    <p class={`status ${status}`} role="status" title={text} data-status={status} data-busy={isBusy} data-old={isOld} data-saved={saved}>
      {transfer && <progress value={transfer.share} max={1} aria-label={`Progress of ${transfer.name}`} />}
      {file && kind === "" && status === "open" && <span class="saving">{saving}</span>}
      {text}
    </p>
  );
}

const groups = [
  { kind: "model", title: "Models" },
  { kind: "scan", title: "Scans" },
  { kind: "results", title: "Results" },
  { kind: "table", title: "Tables" },
];

function FileChoice() {
  const { files, data, file, hello, isRunning } = useStore();
  const unsaved = [...new Set([...(hello?.drafts ?? []), ...(file ? [file] : [])])].filter((name) => !files.includes(name) && !data.some((d) => d.name === name));
  const shown = [...files, ...unsaved];
  const designs = shown.map((name) => <option value={name}>{unsaved.includes(name) ? `${name} (not saved)` : name}</option>);
  return (
    <>
      <label class="design">
        <span class="quiet">Design</span>
        <select class="file" value={file} title={file} onFocus={listFiles} onChange={(e) => openFile(e.currentTarget.value)}>
          {!file && <option value="">choose…</option>}
          {data.length === 0 && designs}
          {data.length > 0 && <optgroup label="Designs">{designs}</optgroup>}
          {groups.filter((g) => data.some((d) => d.kind === g.kind)).map((g) => (
            <optgroup label={g.title}>{data.filter((d) => d.kind === g.kind).map((d) => <option value={d.name}>{d.name}</option>)}</optgroup>
          ))}
        </select>
      </label>
      {file.endsWith(".py") && !isRunning && <button class="main" onClick={runPython}>Run</button>}
      {file.endsWith(".py") && isRunning && <button class="main" onClick={stopPython}>Stop</button>}
    </>
  );
}

function FileMenu() {
  const { file } = useStore();
  const files = useRef<HTMLInputElement>(null), folder = useRef<HTMLInputElement>(null);
  return (
    <>
      <Menu title="File">
        <button onClick={makeDesign}>New…</button>
        <button onClick={() => files.current!.click()} title="Designs, models, scans, results, images, bundles; they can also be dropped on the page">Open files…</button>
        <button onClick={() => folder.current!.click()}>Open folder…</button>
        <button disabled={!file} onClick={renameDesign}>Rename…</button>
        <button disabled={!file} onClick={duplicateDesign}>Duplicate…</button>
        <button disabled={!file} onClick={deleteDesign}>Delete…</button>
        <button onClick={newFolder}>New folder…</button>
        <button disabled={!file} onClick={copyLink} title="The file, view, cut, sliders and camera">Copy link</button>
      </Menu>
      <input ref={files} type="file" multiple hidden accept={openableEndings().join()} aria-label="Files to open" onChange={(e) => openChosen(e.currentTarget)} />
      <input ref={folder} type="file" hidden aria-label="Folder to open" {...{ webkitdirectory: true }} onChange={(e) => openChosen(e.currentTarget)} />
    </>
  );
}

function DownloadMenu() {
  const { design, file, kind, isOld, turntable } = useStore();
  const isShown = design !== undefined && kind !== "table", hasSolid = isShown && !isOld;
  return (
    <Menu title="Download">
      <button disabled={!hasSolid} onClick={() => downloadMesh(".3mf")}>3MF</button>
      <button disabled={!hasSolid} onClick={() => downloadMesh(".stl")}>STL</button>
      <button disabled={!isShown} onClick={takePicture} title="The views that are seen (Alt P)">Picture (PNG)</button>
      <button disabled={!isShown} onClick={() => makeTurntable("webm")} title="The design turned once around (Alt T)">{turntable === undefined ? "Turntable (WebM)" : "Stop the turntable"}</button>
      <button disabled={!isShown || turntable !== undefined} onClick={() => makeTurntable("gif")} title="The design turned once around (Alt G)">Turntable (GIF)</button>
      <button disabled={!file || kind !== "" || file.endsWith(".py")} onClick={downloadBundle} title="The design with the files that it reads, as one file (Alt B)">Bundle</button>
    </Menu>
  );
}

function Theme() {
  const { theme } = useStore();
  return (
    <label>
      <span class="quiet">Theme</span>
      <select aria-label="Theme" value={theme} onChange={(e) => set({ theme: e.currentTarget.value as State["theme"] })}>
        <option value="system">system</option>
        <option value="light">light</option>
        <option value="dark">dark</option>
      </select>
    </label>
  );
}

function Views() {
  const { view: wanted, isOld: isOldText, design } = useStore();
  const isOld = isOldText && design !== undefined;
  const views = viewsToSee();
  const view = views.some((v) => v.name === wanted) ? wanted : views[0].name;
  const isShown = (name: State["view"]) => view === "all" || view === name;
  return (
    <section class={isOld ? "views old" : "views"} aria-label="Views">
      <Tabs label="Views" tabs={views} chosen={view} choose={(name) => set({ view: name })} />
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
    watchView();
    watchDownloads();
    connection.connect(session);
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
        <FileMenu />
        <DownloadMenu />
        <Status />
        <span class="folder" title={hello?.folder}>{hello?.folder}</span>
        <button onClick={() => set({ showsKeys: true })} title="Keys of the page (Alt K)">Keys</button>
        <Theme />
        <a class="quiet program" href="licences.txt" target="_blank" title="Licences of what the page is made of">{hello?.program}</a>
      </header>
      <main>
        <EditorPane />
        <Views />
        <Panels />
      </main>
      <KeysDialog />
      <AskingDialog />
    </>
  );
}

addEventListener("beforeunload", () => isDirty() && save());
render(<App />, document.getElementById("app")!);
