/** What the package gives to pages and to node alike. */
export { EngineError, exportFormats } from '../engine/contract';
export type {
  ElementOrder,
  ErrorCode,
  ErrorPlace,
  ExportFormat,
  FieldInfo,
  Forecast,
  FoundFields,
  Frame,
  Recipe,
  Report,
  Schema,
  SchemaField,
  Simulated,
  SimulationName,
  Space,
  Trace,
  Traces,
} from '../engine/contract';
export { decodeFragment, encodeFragment, LinkError } from '../link/codec';
export type { EmbedEvent, EmbedRequest } from '../link/embed_messages';
export type * from './mesher';

export interface MesherOptions {
  /** False: one thread. Else as many as there are cores, eight at most, where memory may be shared. */
  threads?: boolean;
}
