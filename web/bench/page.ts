/** The page of bench/measures/gateway.py: the driver starts a reception and reads its figures. */

import { socketUrl } from '../src/link/socket'
import { type Ages, receiveLink, receivePlain } from './receive'

declare global {
  interface Window {
    begin(plainUrl: string): void
    ages(): number[]
  }
}

let reception: Ages | null = null

window.begin = (plainUrl) => {
  reception?.stop()
  reception = plainUrl === '' ? receiveLink(socketUrl()) : receivePlain(plainUrl)
}
/** Return the ages so far, and begin a new window. */
window.ages = () => reception?.ages.splice(0) ?? []
