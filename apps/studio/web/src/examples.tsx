// The panel of examples, with their pictures.
import { useEffect, useRef, useState } from "preact/hooks";
import { listExamples, openExample } from "./files";
import { useSearch } from "./search";
import { connection } from "./session/connection";
import { useStore } from "./store";

// The picture of an example, which is asked for when it comes into view.
function ExamplePicture({ name }: { name: string }) {
  const place = useRef<HTMLSpanElement>(null);
  const [url, setUrl] = useState("");
  useEffect(() => {
    const observer = new IntersectionObserver(async ([entry]) => {
      if (!entry.isIntersecting) return;
      observer.disconnect();
      const reply = await connection.ask("example_picture", { name }).answer.catch(() => undefined);
      if (reply?.bytes) setUrl(URL.createObjectURL(new Blob([reply.bytes as BlobPart], { type: "image/png" })));
    });
    observer.observe(place.current!);
    return () => observer.disconnect();
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
