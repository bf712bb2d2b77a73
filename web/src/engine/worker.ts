/** The engine's worker in a page. */
import * as Comlink from 'comlink';
import { api } from './worker_api';

Comlink.expose(api);
