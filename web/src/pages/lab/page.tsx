export function LabPage() {
  return <h1>MR-Lab</h1>
}
