/**
 * Width that a figure likes in a box that is as wide as its contents: that of a book's column. Two dots with so much between them break the
 * line if there is less.
 */
export const likedWidth =
  "content:'. .';display:block;height:0;overflow:hidden;visibility:hidden;white-space:normal;word-spacing:44em";
