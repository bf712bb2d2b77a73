import type { EngineModule } from '../session_api';

export default function createVoxtet(options?: object): Promise<EngineModule>;
