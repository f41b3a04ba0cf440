// @vitest-environment jsdom
import { h, render } from 'preact'
import { act } from 'preact/test-utils'
import { expect, test, vi } from 'vitest'
import { itemOf, Menu } from '../../src/design/menu'

test.each([
  ['ArrowDown', -1, 0],
  ['ArrowDown', 2, 0],
  ['ArrowUp', -1, 2],
  ['ArrowUp', 0, 2],
  ['Home', 1, 0],
  ['End', 1, 2],
  ['a', 1, undefined],
])('%s leads from item %d to %s', (key, at, next) => {
  expect(itemOf(key, at, 3)).toBe(next)
})

test('a menu is used by the keyboard alone', async () => {
  const chosen = vi.fn()
  const items = ['one', 'two'].map((id) => h('button', { id, onClick: chosen, key: id }, id))
  await act(() => render(h(Menu, { label: 'Act', icon: 'more', children: items }), document.body))
  const button = document.querySelector('button') as HTMLButtonElement
  const press = (key: string) =>
    act(() => {
      const event = new KeyboardEvent('keydown', { key, bubbles: true })
      document.activeElement?.dispatchEvent(event)
    })
  button.focus()
  await act(() => button.click())
  expect(document.activeElement?.id).toBe('one')
  await press('ArrowDown')
  expect(document.activeElement?.id).toBe('two')
  await press('Escape')
  expect(document.activeElement).toBe(button)
  expect(document.getElementById('one')).toBeNull()
  await press('ArrowDown')
  await act(() => (document.activeElement as HTMLElement).click())
  expect(chosen).toHaveBeenCalledOnce()
  expect(document.activeElement).toBe(button)
})
