export function InvitationPage() {
  return <h1>MR-Lab</h1>
}
