/** What the lab tells a person, as JSON and messages have it; see core/base/diagnostic.py. */

export interface Fix {
  readonly option: string
  readonly value: string
  readonly matlab: string
  /** Words of an mrlab command line. */
  readonly command?: string
}

export interface Diagnostic {
  readonly severity: 'info' | 'warning' | 'error'
  readonly code: string
  /** In English, for who reads no code. */
  readonly message: string
  readonly remedy: string
  readonly variable: string
  readonly where: string
  /** Rows of the workspace's matrix, from 1; 0: none. */
  readonly first_row: number
  readonly last_row: number
  /** Joint's name; empty: none. */
  readonly joint: string
  readonly value: number | null
  readonly limit: number | null
  readonly unit: string
  readonly values: Readonly<Record<string, unknown>>
  readonly fixes: readonly Fix[]
}
