/**
 * One task at a time, in parts; between two of them a newer task takes over, and of several that wait the newest. But
 * not before the older one has told something: a hand that never rests is followed, too. Pure.
 * @template T what is asked
 * @template F what is found
 */
export class Newest {
  /** @type {{id: number, task: T}|null} */ #next = null;
  #runs = false;

  /**
   * @param {(task: T) => Iterable<F|null>} work  in parts, null after one that finds nothing to tell
   * @param {(id: number, found: F|null, problem?: unknown) => void} tell  null: the task cannot be done
   * @param {() => Promise<unknown>} pause  lets newer tasks arrive
   */
  constructor(work, tell, pause) {
    this.work = work;
    this.tell = tell;
    this.pause = pause;
  }

  /** @param {number} id @param {T} task */
  async put(id, task) {
    this.#next = { id, task };
    if (this.#runs) return;
    this.#runs = true;
    while (this.#next) {
      const { id: own, task: newest } = /** @type {{id: number, task: T}} */ (this.#next);
      this.#next = null;
      await this.#through(own, newest);
    }
    this.#runs = false;
  }

  /** @param {number} id @param {T} task */
  async #through(id, task) {
    let told = false;
    try {
      for (const found of this.work(task)) {
        if (found) this.tell(id, found);
        told ||= found !== null;
        await this.pause();
        if (told && this.#next) return;
      }
    } catch (problem) {
      this.tell(id, null, problem);
      return;
    }
    if (!told) this.tell(id, null);
  }
}
