// SPDX-License-Identifier: BSD-3-Clause
// Undo and redo: what was, what is, what was taken back.

export class History<T> {
  private past: T[] = [];
  private future: T[] = [];
  constructor(private now: T) {}

  get present(): T {
    return this.now;
  }
  get canUndo(): boolean {
    return this.past.length > 0;
  }
  get canRedo(): boolean {
    return this.future.length > 0;
  }

  /** A step that can be taken back. */
  push(next: T): void {
    this.past = [...this.past.slice(-199), this.now];
    this.future = [];
    this.now = next;
  }
  /** Part of the step under way: a drag is one step. */
  replace(next: T): void {
    this.now = next;
  }
  undo(): void {
    const before = this.past.pop();
    if (before === undefined) return;
    this.future.push(this.now);
    this.now = before;
  }
  redo(): void {
    const after = this.future.pop();
    if (after === undefined) return;
    this.past.push(this.now);
    this.now = after;
  }
}
