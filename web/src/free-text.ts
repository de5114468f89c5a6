// Made from homebody-life.

/** The addresses of Ollama and llama.cpp on the machine of Homebody, which are asked without another address. */
export const LOCAL_SERVERS = ['http://localhost:11434/v1', 'http://localhost:8080/v1'] as const;

/** The longest text. */
export const MOST_CHARACTERS = 20000;

/** Most answers about a text. */
export const MOST_ROUNDS = 4;
