export function TrajectoriesPage() {
  return <h1>MR-Lab</h1>
}
