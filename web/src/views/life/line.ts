/** The height of a line of the editor; what stands beside it goes by the same one. */
export const LINE_PX = 24;
