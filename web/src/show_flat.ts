import { FLAT_REPORTS } from './flat_reports'
import { start } from './show'

start(FLAT_REPORTS)
