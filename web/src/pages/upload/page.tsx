export function UploadPage() {
  return <h1>MR-Lab</h1>
}
