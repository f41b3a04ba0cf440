import { REPORTS } from './reports'
import { start } from './show'

start(REPORTS)
