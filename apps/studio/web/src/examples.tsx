// The panel of examples, with their pictures.
import { useEffect, useState } from "preact/hooks";
import { listExamples, openExample } from "./files";
import { useSearch } from "./search";
import { useWhenSeen } from "./seen";
import { Reply, connection } from "./session/connection";
import { useStore } from "./store";

// The picture of an example, which is asked for when it comes into view.
function ExamplePicture({ name }: { name: string }) {
  const [url, setUrl] = useState("");
  const place = useWhenSeen<HTMLSpanElement>(() => {
    const show = (reply: Reply) => reply.bytes && setUrl(URL.createObjectURL(new Blob([reply.bytes as BlobPart], { type: "image/png" })));
    connection.ask("example_picture", { name }).answer.then(show, () => undefined);
  }, [name]);
  useEffect(() => () => URL.revokeObjectURL(url), [url]);
  return <span class="picture" ref={place}>{url && <img src={url} alt={`The example ${name}`} />}</span>;
}

export function Examples() {
  const [examples, setExamples] = useState<{ name: string; sentence: string }[]>([]);
  const { status } = useStore();
  useEffect(() => {
    listExamples().then(setExamples);
  }, [status]);
  const { found, field } = useSearch(examples, (e) => `${e.name} ${e.sentence}`, "examples");
  return (
    <div class="panelbody">
      {field}
      <ul class="examples">
        {found.map((e) => (
          <li key={e.name}>
            <ExamplePicture name={e.name} />
            <span class="words">
              <strong>{e.name}</strong> {e.sentence}
              <button aria-label={`Open a copy of ${e.name}`} onClick={() => openExample(e.name)}>Open a copy</button>
            </span>
          </li>
        ))}
      </ul>
    </div>
  );
}
