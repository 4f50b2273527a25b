/** Cache of one result, valid while its dependencies are the same. */

export class Memo<Answer> {
  #question: unknown[] = [];
  #answer: Answer | undefined;

  /** Returns the cached answer, or asks again. @param question values on which the answer depends, compared by identity */
  of(question: unknown[], ask: () => Answer): Answer {
    if (question.length !== this.#question.length || question.some((part, i) => part !== this.#question[i])) {
      this.#answer = ask();
      this.#question = question;
    }
    return this.#answer as Answer;
  }
}
