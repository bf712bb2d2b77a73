import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { dismissErrors, notices, tell } from './notices';

describe('what the user is told', () => {
  beforeEach(() => {
    notices.value = [];
  });
  afterEach(() => void vi.useRealTimers());
  const titles = () => notices.value.map(({ title }) => title);

  it('is one error at a time', () => {
    tell('news', 'Labels are named', '');
    tell('error', 'First', '');
    tell('error', 'Second', '');
    expect(titles()).toEqual(['Labels are named', 'Second']);
  });

  it('is each piece of news once', () => {
    tell('news', 'One', 'a');
    tell('news', 'Two', 'b');
    tell('news', 'One', 'a');
    expect(titles()).toEqual(['Two', 'One']);
  });

  it('goes by itself where there is nothing to do about it', () => {
    vi.useFakeTimers();
    tell('news', 'Labels are named', '');
    tell('news', 'A new version is there', '', { name: 'Reload', go: () => undefined });
    vi.runAllTimers();
    expect(titles()).toEqual(['A new version is there']);
  });

  it('is no error any more when something is asked for anew', () => {
    tell('news', 'Labels are named', '');
    tell('error', 'First', '');
    dismissErrors();
    expect(titles()).toEqual(['Labels are named']);
  });
});
