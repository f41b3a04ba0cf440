export function PeoplePage() {
  return <h1>MR-Lab</h1>
}
