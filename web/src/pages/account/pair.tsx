export function PairPage() {
  return <h1>MR-Lab</h1>
}
