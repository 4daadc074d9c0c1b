import { describe, expect, it } from 'vitest';
import { delayOf, parseStream } from './event_stream';

describe('the stream of events', () => {
  it('is read message by message, and what is unfinished waits for its rest', () => {
    const first = parseStream(': from event 41\n\nid: 42\nevent: alert.opened\ndata: {"alert":1}\n\nid: 43\nda');
    expect(first.comments).toEqual(['from event 41']);
    expect(first.messages).toEqual([{ id: '42', type: 'alert.opened', data: '{"alert":1}' }]);
    const second = parseStream(`${first.rest}ta: {"text": "a: b"}\n\n`);
    expect(second).toEqual({
      messages: [{ id: '43', type: 'message', data: '{"text": "a: b"}' }],
      comments: [],
      rest: '',
    });
  });

  it('is the same however it is cut', () => {
    const text = 'id: 1\nevent: a\ndata: one\ndata: two\n\n: still here\n\nid: 2\nevent: b\ndata: three\n\n';
    const whole = parseStream(text);
    expect(whole.messages.map((message) => message.data)).toEqual(['one\ntwo', 'three']);
    for (let cut = 1; cut < text.length; ++cut) {
      const first = parseStream(text.slice(0, cut));
      const second = parseStream(first.rest + text.slice(cut));
      expect([...first.messages, ...second.messages]).toEqual(whole.messages);
    }
  });

  it('is tried again ever less often, but every few seconds', () => {
    expect([1, 2, 3, 4, 5, 20].map(delayOf)).toEqual([500, 1000, 2000, 4000, 5000, 5000]);
  });
});
