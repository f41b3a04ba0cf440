// @vitest-environment jsdom
import { h, render } from 'preact'
import { act } from 'preact/test-utils'
import { beforeEach, expect, test, vi } from 'vitest'
import { PeoplePage } from '../../../src/pages/people/page'
import { ApiProvider, session } from '../../../src/shell/session'
import { FakeApi } from '../../fake_api'

const settled = () => act(() => new Promise((resolve) => setTimeout(resolve, 5)))
const button = (text: string) => {
  const found = [...document.querySelectorAll('button')].find((each) => each.textContent === text)
  if (found === undefined) throw new Error(`no button ${text}`)
  return found
}
const send = (element: HTMLElement, kind: string) =>
  act(() => {
    element.dispatchEvent(new Event(kind, { bubbles: true }))
  })
const choose = (label: string, value: string) => {
  const of = [...document.querySelectorAll('label')].find((each) => each.textContent === label)
  const select = document.getElementById(of?.htmlFor ?? '') as HTMLSelectElement
  select.value = value
  return send(select, 'change')
}

let api: FakeApi

beforeEach(async () => {
  HTMLDialogElement.prototype.showModal = () => undefined
  api = new FakeApi()
  session.value = await api.session()
  render(null, document.body)
  render(h(ApiProvider, { value: api }, h(PeoplePage, {})), document.body)
  await settled()
})

test('a token is made for a program, shown once, and the program is in the list', async () => {
  await act(() => button('Add a program').click())
  const name = document.querySelector<HTMLInputElement>('dialog input')
  if (name === null) throw new Error('a field for the name')
  name.value = 'matlab'
  await send(name, 'input')
  await act(() => button('Make a token').click())
  await settled()
  expect(document.querySelector('.token')?.textContent).toBe('mrlab_abc')
  await act(() => button('Close').click())
  await settled()
  expect(document.querySelector('[data-device="matlab"]')).not.toBeNull()
  expect(document.querySelector('.token')).toBeNull()
})

test('whoever is removed leaves what was chosen to whom was chosen', async () => {
  const remove = vi.spyOn(api, 'removePerson')
  const menus = () => document.querySelectorAll<HTMLButtonElement>('.people-menu button')
  await vi.waitFor(() => expect(menus()).toHaveLength(3))
  await act(() => menus()[1]?.click())
  await act(() => button('Remove').click())
  await choose('Trajectories and uploads', 'hand_over')
  await choose('Who gets them', 'beamer')
  const buttons = [...document.querySelectorAll<HTMLButtonElement>('dialog button')]
  await act(() => buttons.at(-1)?.click())
  await settled()
  expect(remove).toHaveBeenCalledWith('grace', { data: 'hand_over', to: 'beamer' })
})
