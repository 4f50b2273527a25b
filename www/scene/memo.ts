/** Cache of one result, valid while its dependencies are the same. */

export class Memo<Result> {
  #lastKey: unknown[] = [];
  #lastResult: Result | undefined;

  /** Returns the cached result, or computes it again. @param key values on which the result depends, compared by identity */
  get(key: unknown[], compute: () => Result): Result {
    if (key.length !== this.#lastKey.length || key.some((part, i) => part !== this.#lastKey[i])) {
      this.#lastResult = compute();
      this.#lastKey = key;
    }
    return this.#lastResult as Result;
  }
}
