import { ahead, following, type LinkRecord, readRecord } from './frames'

/** The lossless channel from the gateway: each record once and in order, across sockets. */
export class ReliableReceiver {
  private pieces: Uint8Array[] = []
  private size = 0
  /** Number of the last fragment that is here. */
  received = 0

  /** Take a fragment; return the record that it completes, or null. A fragment that an earlier
   * socket delivered is ignored. */
  take(number: number, last: boolean, data: Uint8Array): LinkRecord | null {
    if (ahead(number, this.received) <= 0) return null
    if (number !== following(this.received)) {
      throw new Error(`fragment ${number} came behind ${this.received}`)
    }
    this.received = number
    if (last && this.pieces.length === 0) return readRecord(data)
    this.pieces.push(data)
    this.size += data.length
    if (!last) return null
    const whole = new Uint8Array(this.size)
    let at = 0
    for (const piece of this.pieces) {
      whole.set(piece, at)
      at += piece.length
    }
    this.clearPieces()
    return readRecord(whole)
  }

  /** Restart: the gateway does not know this client any more. */
  clear(): void {
    this.received = 0
    this.clearPieces()
  }

  private clearPieces(): void {
    this.pieces = []
    this.size = 0
  }
}
