// @vitest-environment jsdom
import { expect, test } from 'vitest'
import { checkSignIn, session } from '../../src/shell/session'
import { FakeApi } from '../fake_api'

test('somebody whose sign-in was ended is led to the page that says so', async () => {
  const api = new FakeApi()
  const signedIn = await api.session()
  session.value = signedIn
  await checkSignIn(api)
  expect(location.pathname).toBe('/')
  api.session = () => Promise.reject(new Error('no answer'))
  await checkSignIn(api)
  expect(session.value?.user).not.toBeNull()
  api.session = () => Promise.resolve({ ...signedIn, user: null })
  await checkSignIn(api)
  expect(session.value?.user).toBeNull()
  expect(location.pathname + location.search).toBe('/sign-in?problem=ended')
})
