/**
 * What a figure would like where a box is as wide as its contents: the column of a book, from where on each row of buttons is
 * one line. Two dots with so much between them, where the line breaks if there is less.
 */
export const likedWidth =
  "content:'. .';display:block;height:0;overflow:hidden;visibility:hidden;white-space:normal;word-spacing:44em";
