// The connection to the program: PROTOCOL.md. Reconnects with increasing intervals.

export interface Message {
  t: string;
  [member: string]: unknown;
}

export interface Answer {
  id: number;
  result: string;
  text: string;
  [member: string]: unknown;
}

export type LinkState = "connecting" | "open" | "lost" | "replaced";

const kFirstDelay = 500;
const kLongestDelay = 10_000;
const kPlaceTaken = 4001;
const kTick = 1000;
// Ticks without a message. The program sends one every 400 ms, and answers a ping before a login too.
const kPingAfter = 2;
const kDropAfter = 5;

export class Wire {
  state: LinkState = "connecting";
  private socket: WebSocket | null = null;
  private delay = kFirstDelay;
  private timer = 0;
  private quiet = 0; // ticks since the last message; a suspended tab counts none
  private nextId = 1;
  private readonly waiting = new Map<number, { resolve: (answer: Answer) => void; progress?: (m: Message) => void }>();

  constructor(private readonly onMessage: (message: Message) => void, private readonly onState: (state: LinkState) => void) {
    setInterval(() => this.listen(), kTick);
  }

  connect(): void {
    clearTimeout(this.timer);
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const socket = new WebSocket(`${scheme}://${location.host}/live`);
    this.socket = socket;
    this.quiet = 0;
    socket.onopen = () => {
      this.delay = kFirstDelay;
      this.set("open");
    };
    socket.onmessage = (event) => { if (this.socket === socket) this.take(String(event.data)); };
    socket.onclose = (event) => {
      if (this.socket !== socket) return;
      if (event.code === kPlaceTaken) {
        this.fail();
        return this.set("replaced");
      }
      this.lose();
    };
  }

  private lose(): void {
    this.socket = null;
    this.fail();
    this.set("lost");
    this.connectLater();
  }

  /** A line that was pulled closes nothing: silence tells. */
  private listen(): void {
    const socket = this.socket;
    if (!socket || this.state === "replaced") return;
    ++this.quiet;
    if (this.quiet === kPingAfter && this.state === "open") void this.ask({ do: "ping" });
    if (this.quiet < kDropAfter) return;
    this.lose();
    socket.close();
  }

  /** Half to all of a delay that doubles: pages of one machine do not come all at once. */
  private connectLater(): void {
    const wait = this.delay * (0.5 + Math.random() / 2);
    this.delay = Math.min(this.delay * 2, kLongestDelay);
    this.timer = window.setTimeout(() => this.connect(), wait);
  }

  /** At once, for somebody who looks at the page again. */
  hurry(): void {
    if (this.state !== "lost" || this.socket?.readyState === WebSocket.CONNECTING) return;
    this.delay = kFirstDelay;
    this.connect();
  }

  private set(state: LinkState): void {
    this.state = state;
    this.onState(state);
  }

  private fail(): void {
    for (const [id, entry] of this.waiting)
      entry.resolve({ id, result: "lost", text: "the connection was lost before the answer; whether it was done is not known" });
    this.waiting.clear();
  }

  private take(text: string): void {
    this.quiet = 0;
    const message = JSON.parse(text) as Message;
    if (message.t === "answer" || message.t === "progress") {
      const entry = this.waiting.get(message.id as number);
      if (message.t === "progress") return entry?.progress?.(message);
      this.waiting.delete(message.id as number);
      return entry?.resolve(message as unknown as Answer);
    }
    this.onMessage(message);
  }

  ask(request: Record<string, unknown>, progress?: (message: Message) => void): Promise<Answer> {
    const id = this.nextId++;
    return new Promise((resolve) => {
      if (this.socket?.readyState !== WebSocket.OPEN)
        return resolve({ id, result: "lost", text: "there is no connection; nothing was sent" });
      this.waiting.set(id, { resolve, progress });
      this.socket.send(JSON.stringify({ id, ...request }));
    });
  }
}
