// The daemon's stream of events (SSE), which picks up after every interruption exactly where it was.
//
// Read with fetch, not with EventSource: that one gives up for good on a 503, says nothing about how it stands, and
// cannot be told which event it should go on from after the page was loaded.

export type LiveState =
  | { readonly state: 'connecting' }
  | { readonly state: 'live' }
  | { readonly state: 'reconnecting'; readonly since_ms: number; readonly attempts: number }
  | { readonly state: 'offline'; readonly since_ms: number; readonly attempts: number };

/** One message of a stream; `id`, `type` and `data` as the daemon wrote them. */
export interface StreamMessage {
  readonly id: string;
  readonly type: string;
  readonly data: string;
}

/** What a piece of the stream holds. @returns the whole messages and comments, and what is left of an unfinished one. */
export function parseStream(text: string): { messages: StreamMessage[]; comments: string[]; rest: string } {
  const blocks = text.split('\n\n');
  const rest = blocks.pop() ?? '';
  const messages: StreamMessage[] = [];
  const comments: string[] = [];
  for (const block of blocks) {
    const message = { id: '', type: 'message', data: '' };
    for (const line of block.split('\n')) {
      const colon = line.indexOf(':');
      const field = line.slice(0, colon);
      const value = line.slice(colon + 1).replace(/^ /, '');
      if (colon === 0) comments.push(value);
      else if (field === 'id') message.id = value;
      else if (field === 'event') message.type = value;
      else if (field === 'data') message.data += (message.data === '' ? '' : '\n') + value;
    }
    if (message.data !== '') messages.push(message);
  }
  return { messages, comments, rest };
}

const kFirstDelayMs = 500;
const kMostDelayMs = 5_000;
/** After so many attempts in vain it is called offline. */
const kOfflineAfter = 4;
/** The daemon says every 15 s that it is there; after this silence the connection is taken for dead. */
const kSilenceMs = 40_000;

export function delayOf(attempts: number): number {
  return Math.min(kMostDelayMs, kFirstDelayMs * 2 ** Math.max(0, attempts - 1));
}

export interface EventStreamOptions {
  url: string;
  onMessage: (message: StreamMessage) => void;
  onState: (state: LiveState) => void;
  /** The stream stands; `resumed` when it is not the first time. */
  onOpen?: (resumed: boolean) => void;
}

export class EventStream {
  private lastId = '';
  private attempts = 0;
  private since_ms = 0;
  private opened = false;
  private stopped = false;
  private abort = new AbortController();
  private wake: (() => void) | undefined;

  constructor(private readonly options: EventStreamOptions) {}

  start(): void {
    void this.run();
  }

  stop(): void {
    this.stopped = true;
    this.abort.abort();
    this.wake?.();
  }

  /** Tries again at once, for example when the machine is back on its network. */
  retryNow(): void {
    this.wake?.();
  }

  private async run(): Promise<void> {
    this.options.onState({ state: 'connecting' });
    while (!this.stopped) {
      try {
        await this.readOnce();
      } catch {
        // Whatever ended it, the answer is to try again.
      }
      if (this.stopped) return;
      this.attempts += 1;
      if (this.attempts === 1) this.since_ms = Date.now();
      const state = this.attempts > kOfflineAfter || !navigator.onLine ? 'offline' : 'reconnecting';
      this.options.onState({ state, since_ms: this.since_ms, attempts: this.attempts });
      await this.pause(delayOf(this.attempts));
    }
  }

  private async readOnce(): Promise<void> {
    this.abort = new AbortController();
    const headers: Record<string, string> = { Accept: 'text/event-stream' };
    if (this.lastId !== '') headers['Last-Event-ID'] = this.lastId;
    const response = await fetch(this.options.url, { headers, cache: 'no-store', signal: this.abort.signal });
    if (!response.ok || !response.body) throw new Error(`HTTP ${response.status}`);
    this.attempts = 0;
    this.options.onState({ state: 'live' });
    this.options.onOpen?.(this.opened);
    this.opened = true;
    await this.readBody(response.body.pipeThrough(new TextDecoderStream()).getReader());
  }

  private async readBody(reader: ReadableStreamDefaultReader<string>): Promise<void> {
    let text = '';
    for (;;) {
      const silence = setTimeout(() => this.abort.abort(), kSilenceMs);
      const piece = await reader.read().finally(() => clearTimeout(silence));
      if (piece.done) return;
      const { messages, comments, rest } = parseStream(text + piece.value);
      text = rest;
      // The first comment says after which event the stream begins: with it nothing is missed before the first event.
      for (const comment of comments) this.lastId = /^from event (\d+)$/.exec(comment)?.[1] ?? this.lastId;
      for (const message of messages) {
        if (message.id !== '') this.lastId = message.id;
        this.options.onMessage(message);
      }
    }
  }

  private pause(ms: number): Promise<void> {
    return new Promise((resolve) => {
      const timer = setTimeout(resolve, ms);
      this.wake = () => {
        clearTimeout(timer);
        resolve();
      };
    });
  }
}
