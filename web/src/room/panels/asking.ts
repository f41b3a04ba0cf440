/** s within which a second press confirms the first. */
export const CONFIRM_S = 10

/** Asks before a destructive act: only a second press of the same button carries it out. */
export class Asking {
  private asked = ''
  private askedAt = Number.NEGATIVE_INFINITY

  /** say: shows the question. now: s. */
  constructor(
    private readonly say: (question: string) => void,
    private readonly now = () => performance.now() / 1000,
  ) {}

  /** A button was pressed. id: of the act. */
  press(id: string, question: string, act: () => void): void {
    const now = this.now()
    if (this.asked === id && now - this.askedAt <= CONFIRM_S) {
      this.asked = ''
      act()
      return
    }
    this.asked = id
    this.askedAt = now
    this.say(question)
  }
}
