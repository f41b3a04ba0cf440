export function SignInPage() {
  return <h1>MR-Lab</h1>
}
