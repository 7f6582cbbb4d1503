// The socket to the server: questions with answers, and events. It connects again when the server comes back.

export type Json = null | boolean | number | string | Json[] | { [key: string]: Json };

export interface Reply {
  [key: string]: any;
  bytes?: Uint8Array;
}

export class Refused extends Error {
  constructor(
    readonly code: string,
    message: string,
  ) {
    super(message);
  }
  get isCancelled() {
    return this.code === "cancelled" || this.code === "lost";
  }
}

// An answer that does not come is no mistake of the page, which shows that the connection is lost.
window.addEventListener("unhandledrejection", (event) => {
  if (event.reason instanceof Refused && event.reason.isCancelled) event.preventDefault();
});

interface Waiting {
  lane: string;
  resolve: (reply: Reply) => void;
  reject: (error: Refused) => void;
}

// The token comes with the address that the server prints. The browser keeps it for this origin, to which the port
// belongs, and takes it out of the address. A cookie would go to the other ports of this machine as well.
const tokenKey = "ombre:token";
const token = () => localStorage.getItem(tokenKey) ?? "";

function keepToken() {
  const query = new URLSearchParams(location.search);
  const given = query.get("token");
  if (!given) return;
  localStorage.setItem(tokenKey, given);
  query.delete("token");
  history.replaceState(null, "", location.pathname + (query.size > 0 ? `?${query}` : ""));
}
keepToken();

export interface Listener {
  opened(): void;
  lost(): void;
  refused(): void;
  event(name: string, members: Reply): void;
}

export class Connection {
  private socket?: WebSocket;
  private waiting = new Map<number, Waiting>();
  private newest = new Map<string, number>(); // the last request of each lane
  private last = 0;
  private listener?: Listener;

  connect(listener: Listener) {
    this.listener = listener;
    this.open();
  }

  private open() {
    const socket = new WebSocket(`ws://${location.host}/api?token=${token()}`);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.socket = socket;
      this.listener?.opened();
    };
    socket.onmessage = (message) => this.take(message.data);
    socket.onclose = () => this.closed();
  }

  get isOpen() {
    return this.socket?.readyState === WebSocket.OPEN;
  }

  // Asks a question. Returns the promise of an answer, and a function that says that it is no longer needed. A request
  // takes the place of the one before in its lane, whose answer no longer counts though it may have been sent already.
  ask(what: string, members: Record<string, unknown> = {}, lane = ""): { answer: Promise<Reply>; cancel: () => void } {
    const id = ++this.last;
    const answer = new Promise<Reply>((resolve, reject) => {
      if (!this.isOpen) return reject(new Refused("lost", "the studio's server is not there"));
      this.waiting.set(id, { lane, resolve, reject });
      this.newest.set(lane, id);
      this.socket!.send(JSON.stringify({ id, do: what, ...(lane ? { lane } : {}), ...members }));
    });
    return { answer, cancel: () => this.waiting.has(id) && this.isOpen && this.socket!.send(JSON.stringify({ id, do: "cancel" })) };
  }

  // Cancels the request that works in a lane.
  cancelLane(lane: string) {
    if (this.isOpen) this.socket!.send(JSON.stringify({ id: 0, do: "cancel", lane }));
  }

  private take(data: string | ArrayBuffer) {
    let reply: Reply;
    if (typeof data === "string") {
      reply = JSON.parse(data);
    } else {
      const length = new DataView(data).getUint32(0, true);
      reply = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)));
      reply.bytes = new Uint8Array(data, 4 + length);
    }
    if (reply.event) return this.listener?.event(reply.event, reply);
    const waiting = this.waiting.get(reply.id);
    if (!waiting) return;
    this.waiting.delete(reply.id);
    if (waiting.lane && this.newest.get(waiting.lane) !== reply.id) waiting.reject(new Refused("cancelled", "a newer request took its place"));
    else if (reply.error) waiting.reject(new Refused(reply.error, reply.message));
    else waiting.resolve(reply);
  }

  private closed() {
    const wasOpen = this.socket !== undefined;
    this.socket = undefined;
    for (const waiting of this.waiting.values()) waiting.reject(new Refused("lost", "the connection was lost"));
    this.waiting.clear();
    if (wasOpen) this.listener?.lost();
    this.tryAgain();
  }

  // Tries to connect again. A server that was restarted has another token, which this page knows once its new address
  // was opened in any window.
  private async tryAgain() {
    await new Promise((done) => setTimeout(done, 700));
    try {
      const answer = await fetch("/api", { method: "HEAD", headers: { Authorization: `Bearer ${token()}` } });
      if (answer.status === 403) this.listener?.refused();
      if (answer.ok) return this.open();
    } catch {
      // The server is not there yet.
    }
    this.tryAgain();
  }
}

// The page's only one.
export const connection = new Connection();
