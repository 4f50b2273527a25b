/** Cache of one result, valid while its dependencies are the same. */

export class Memo<Answer> {
  #lastQuestion: unknown[] = [];
  #lastAnswer: Answer | undefined;

  /** Returns the cached answer, or asks again. @param question values on which the answer depends, compared by identity */
  of(question: unknown[], ask: () => Answer): Answer {
    if (question.length !== this.#lastQuestion.length || question.some((part, i) => part !== this.#lastQuestion[i])) {
      this.#lastAnswer = ask();
      this.#lastQuestion = question;
    }
    return this.#lastAnswer as Answer;
  }
}
