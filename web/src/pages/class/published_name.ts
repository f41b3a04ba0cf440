/** Return the name under which a submission's motion is published, for its teacher alone. */
export function publishedName(key: string): string {
  const plain = key.toLowerCase().replace(/[^a-z0-9]+/g, '_')
  return `class_${plain.replace(/^_+|_+$/g, '')}`.slice(0, 60)
}
