// Small pictures of what the examples of nodes and operators make.
import { useState } from "preact/hooks";
import { useWhenSeen } from "./seen";
import { connection } from "./session/connection";

const pictures = new Map<string, Promise<string>>(); // addresses, or "" for none, by the names of nodes
let last: Promise<unknown> = Promise.resolve();

// Asks for the picture of a node's example, one after the other.
function pictureOf(name: string): Promise<string> {
  const known = pictures.get(name);
  if (known) return known;
  const made = last.then(async () => {
    const reply = await connection.ask("node_picture", { name, node: 0, width: 96, height: 72 }).answer.catch(() => undefined);
    return reply?.bytes?.length ? URL.createObjectURL(new Blob([reply.bytes as BlobPart], { type: "image/png" })) : "";
  });
  last = made;
  pictures.set(name, made);
  return made;
}

export function NodePicture({ name }: { name: string }) {
  const [url, setUrl] = useState("");
  const place = useWhenSeen<HTMLSpanElement>(() => void pictureOf(name).then(setUrl), [name]);
  return <span class="picture" ref={place}>{url && <img src={url} alt="" width={48} height={36} />}</span>;
}
